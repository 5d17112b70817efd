"""Small decks whose figures can be worked out by hand."""

from __future__ import annotations

CLEAN = """\
$MODEL
*OCEAN
 100.0, 1025.0, 9.81
*NODE
 1, -0.1, 0.0
 2, -0.1, 10.0
 3, 0.3, 20.0
*ELEMENT
 1, 1, 2
 2, 2, 3
*ELEMENT SETS
 SET=Pipe
 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=Pipe
 207.0E9, 79.6E9, 0.5, 0.46, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Pipe
 STIFFNESS=Clay
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.1, 1000.0
 0.5, 3000.0
"""
"""Element 1 lies 0.1 deep: ratio 0.2, force 1500 per length over 10; element 2 is 0.1 above the bed."""

BAD_NUMBER = CLEAN.replace(" 2, -0.1, 10.0\n", " 2, -0.1, ten\n")
"""A SYN002 at 6:11, and nothing else."""

UNSORTED = CLEAN.replace(" 0.0, 0.0\n 0.1, 1000.0\n", " 0.1, 1000.0\n 0.0, 0.0\n")
"""A CRV002 (info) at 25:2, and nothing else."""

UNUSED = CLEAN + " CURVE=Sand\n 0.0, 0.0\n 0.1, 1.0\n"
"""A REF003 and a UNT002 (warnings)."""

LINEAR = CLEAN.replace("STIFFNESS=Clay", "STIFFNESS=20000.0").partition("*SEABED STIFFNESS")[0]

PULLING = CLEAN.replace(" 0.0, 0.0\n", " 0.0, -500.0\n").replace(" 0.1, 1000.0\n", " 0.3, -100.0\n")
"""The curve pulls where element 1 lies: at ratio 0.2 it has -500 + 0.2 * 400 / 0.3."""

ILLEGAL = CLEAN.replace("SET=Pipe\n STIFFNESS", "SET=Pipework\n STIFFNESS")
"""A set that is not defined."""

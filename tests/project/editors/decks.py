"""Decks on which the lexer and the grammar are compared with mudline."""

from __future__ import annotations

from tests.cli.runner import ROOT

SAMPLES = sorted([*ROOT.glob("samples/*.keyx?"), *ROOT.glob("docs/examples/*.keyx?")])

HOSTILE = (
    "C before\n 1, 2\n*NODE\n 1, 2\nC comment\nCurve=a\n",
    "$MODEL\n*SEABED STIFFNESS\nCURVE=a\nCURVES=b\nC\nc lower\ncURVE=x\nC-- dashes\nC- one\n 1 2 3\n 1 2 x\n",
    "$model \n * seabed  stiffness \nCurve = a b \n  CURVE=a\n",
    "$LOAD CASE\n*SEABED STIFFNESS\nCURVE=a\n CURVE=b\n*TIME\n STEP=fixed\n STEP=FIXED, X=1\n 1.0D3, .5, 1., 1.e3\n",
    "$MODEL\n*GEOMETRIC SETS\nCOMPRESSION CHECK=a\n OPTION= rigid , SET=RIGID\n , 1, , 2,\n",
    '$PREPROCESSOR\n*PARAMETERS\n a, /x:1, y:=[a, b]/\n b, =[if(a > 1 and b, "x]", 2)]\n c, "a, b"\n d, {e, f}\n',
    '$MODEL\n*OCEAN\n =[a\n "b, 1\n {c, 1\n*X\n [1, 2], a[3, 4]\n A=[1, 2], B==[c[1, 2], 3], 4\n',
    "$NO SECTION\n*NO KEYWORD\n KEY=value, 1, OTHER KEY = 2\nCOMMENT=1\n$\n*\n",
    "$MODEL\n*OCEAN\n 10O, 1e, -, +1, --1, 1.2.3, 0x10, 1_0, nan, 1e999\n",
    "$MODEL\r\n*NODE\r\n 1, 0, 0\r\nC\r\nC text\r\n 1 2 3\r\n",
    "\u00e4 = 1\n$MODEL\n*ELEMENT SETS\n SET=\u00c4\u00d6 \U0001f600\n \u00fc=3\n",
)

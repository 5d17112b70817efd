"""Every declaration of the library; `make index` makes this of them: change those."""

# fmt: off
from __future__ import annotations

from mudline.keywords.values import Entry

ENTRIES: tuple[Entry, ...] = (
    Entry("COMBINATIONS", "combinations", ("PREPROCESSOR",), "deck"),
    Entry("PARAMETERS", "parameters", ("PREPROCESSOR",), "deck"),
    Entry("VARIATION", "variation", ("PREPROCESSOR",), "deck"),
    Entry("UNITS", "units", ("ANALYSIS",), "deck"),
    Entry("CABLE", "cable", ("MODEL",), "model", kept=True),
    Entry("ELEMENT", "element", ("MODEL",), "model"),
    Entry("ELEMENT SETS", "element_sets", ("MODEL",), "model"),
    Entry("GEOMETRIC SETS", "geometric_sets", ("MODEL",), "model"),
    Entry("LINE LOCATIONS", "line_locations", ("MODEL",), "model", kept=True),
    Entry("LINE PATH SECTIONS", "line_path_sections", ("MODEL",), "model"),
    Entry("LINE PATHS", "line_paths", ("MODEL",), "model", kept=True),
    Entry("LINE SECTION GROUPS", "line_section_groups", ("MODEL",), "model"),
    Entry("LINES", "lines", ("MODEL",), "model", kept=True),
    Entry("NODE", "node", ("MODEL",), "model"),
    Entry("NODE,CURVILINEAR", "node_curvilinear", ("MODEL",), "model", kept=True),
    Entry("OCEAN", "ocean", ("MODEL",), "model"),
    Entry("ELASTIC SURFACE", "elastic_surface", ("MODEL",), "seabed"),
    Entry("EMBEDMENT", "embedment", ("MODEL",), "seabed"),
    Entry("P-Y", "p_y", ("MODEL",), "seabed"),
    Entry("RIGID SURFACE", "rigid_surface", ("MODEL",), "seabed"),
    Entry("SEABED CONTACT", "seabed_contact", ("MODEL",), "seabed"),
    Entry("SEABED FRICTION", "seabed_friction", ("MODEL",), "seabed"),
    Entry("SEABED PLANES", "seabed_planes", ("MODEL",), "seabed"),
    Entry("SEABED PROFILE", "seabed_profile", ("MODEL",), "seabed"),
    Entry("SEABED PROPERTIES", "seabed_properties", ("MODEL",), "seabed"),
    Entry("SEABED STIFFNESS", "seabed_stiffness", ("MODEL",), "seabed"),
    Entry("SEABED SUCTION", "seabed_suction", ("MODEL",), "seabed"),
    Entry("SEABED TRENCH", "seabed_trench", ("MODEL",), "seabed"),
    Entry("SEABED UNLOADING", "seabed_unloading", ("MODEL",), "seabed"),
    Entry("T-Z", "t_z", ("MODEL",), "seabed"),
    Entry("FRICTION", "friction", ("LOAD CASE", "MODES"), "seabed"),
    Entry("NO FRICTION", "no_friction", ("LOAD CASE",), "seabed", kept=True, sections_inferred=True),
    Entry("BOUNDARY", "boundary", ("LOAD CASE",), "loads"),
    Entry("RESTART", "restart", ("LOAD CASE",), "analysis"),
    Entry("TIME", "time", ("LOAD CASE",), "analysis"),
)

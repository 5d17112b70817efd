"""Every keyword of the library: its example goes through every form, a wrong value is told with its place."""

from __future__ import annotations

from typing import Any, cast

import pytest

from mudline.language.deck.loading import dump
from mudline.language.deck.model import Opaque
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_read, keeps_lines
from mudline.language.keywords.model import Block
from tests.helpers.builders.scenes import all_reported, deck_of, faults
from tests.language.deck.test_forms import held

BLOCKS = {block.rule: block for block in catalogue.block_classes()}


def in_section(rule: str, lines: str) -> str:
    return f"${BLOCKS[rule].sections[0]}\n{lines}"


def only(rule: str, lines: str) -> Block:
    (found,) = deck_of(in_section(rule, lines)).sections[0].blocks
    assert not isinstance(found, Opaque)
    return found


def written(rule: str, lines: str) -> dict[str, object]:
    return only(rule, lines).model_dump(mode="json", exclude_defaults=True)


@pytest.mark.parametrize("declared", BLOCKS.values())
def test_the_example_is_read_without_a_finding_and_goes_through_every_form(declared: type[Block]) -> None:
    for section in declared.sections:
        text = f"${section}\n{declared.example}"
        deck = deck_of(text)
        assert deck.problems == []
        assert type(deck.sections[0].blocks[0]) is declared
        assert is_read(deck.sections[0].blocks[0]) or keeps_lines(declared)
        held(deck)
        assert dump(deck_of(dump(deck, "keyword")), "keyword") == dump(deck, "keyword")


FAULTS = [
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, 0.32\n", "4:2 SYN003"),
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, -0.32, 0.4\n", "4:26 SBD010"),
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, 0.25, 0.4\n", "4:20 GEO001"),
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, 0.32, 0.4, 0.45\n", "4:37 GEO001"),
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, 0.4, 0.26\n", "4:31 GEO001"),
    ("taper|*TAPER\n SET=ALL\n 2E11, 8E10, 7850, 0.27, 0.4, 0.3\n COMPRESSION CHECK=NONE\n", ""),
    ("plastic_hardening|*PLASTIC HARDENING\n NAME=a\n 450E6, 0\n 500E6, -0.02\n", "5:9 SBD010"),
    ("plastic_hardening|*PLASTIC HARDENING\n NAME=a, TENSION VARIATION=x\n 450E6, 0\n 500E6, 0.02\n", "3:28 SYN002"),
    ("nonlinear_stiffener|*NONLINEAR STIFFENER\n CURVE=a\n 0, x\n 1E6, 0.02\n", "4:5 SYN002"),
    ("s_n_curve|*S-N CURVE\n CURVE=a, TYPE=LOG LINEAR\n 3, 1E12\n", "3:16 SYN005"),
    ("s_n_curve|*S-N CURVE\n CURVE=a, TYPE=DATA PAIRS\n 200, 1E5, 50\n", "4:2 SYN003"),
    ("s_n_curve|*S-N CURVE\n CURVE=a, TYPE=LOG-LINEAR\n", "3:2 SYN001"),
    ("s_n_curve|*S-N CURVE\n CURVE=a, TYPE=LOG-LINEAR\n 3, 1E12\n 3, 1E12, 0, 1E7\n", "3:2 SYN001"),
    ("fatigue_data|*FATIGUE DATA\n SET=a\n CURVE=b, STRESS=SHEAR\n", "4:18 SYN005"),
    ("fatigue_data|*FATIGUE DATA\n SET=a\n", "3:2 SYN014"),
    ("seastate_files|*SEASTATE FILES\n PIP VIV AUTOGENERATE=NO\n FILE=a\n PERCENT=120\n", "5:10 SBD010"),
    ("seastate_files|*SEASTATE FILES\n FILE=a\n", "3:2 SYN014"),
    ("winch|*WINCH\n SET=ALL\n 0.5, 10, 15, 60\n", "4:2 SYN003"),
    ("winch|*WINCH\n SET=ALL\n LENGTH=4 m\n", "4:9 SYN002"),
    ("winch|*WINCH\n SET=ALL\n", "3:2 SYN014"),
    ("damping_formulation|*DAMPING FORMULATION\n OPTION=CONST\n", "3:9 SYN005"),
    ("point_buoy|*POINT BUOY\n 12, 25000, 9000\n 1, 1, 1\n 1, 1\n 1, 1, 1\n", "5:2 SYN003"),
    ("point_buoy|*POINT BUOY\n 12, 25000, 9000\n 1, 1, 1\n 1, 1, 1\n", "3:2 SYN014"),
    ("point_buoy|*POINT BUOY\n OPTION=6D\n 12, 25000, 9000\n 1, 1, 1\n", "3:9 SYN005"),
    ("time_stepping|*TIME STEPPING\n TYPE=HILBER-HUGHES\n 0.2\n", "4:2 SBD010"),
    ("time_stepping|*TIME STEPPING\n TYPE=HILBER-HUGHES, P-INFINITY=0.4\n", "2:1 SYN001"),
    ("time_stepping|*TIME STEPPING\n TYPE=NEWMARK\n", "3:7 SYN005"),
    ("hydrodynamic_sets|*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n 1.0\n blah blah\n", "5:2 SYN001"),
    ("hydrodynamic_sets|*HYDRODYNAMIC SETS\n blah\n SET=A, TYPE=REYNOLDS\n 1E4, 1.2\n", "3:2 SYN001"),
    ("hydrodynamic_sets|*HYDRODYNAMIC SETS\n OPTION=REYNOLDS\n SET=ALL, TYPE=REYNOLDS\n 1E4, 1.2\n 1E6, 0.7\n", ""),
    ("drag_chain|*DRAG CHAIN\n GEN=12, 5\n 12, 20, 140\n", "3:6 REF010"),
    ("drag_chain|*DRAG CHAIN\n 12, 20, 140\n GEN=12, 5\n", ""),
    ("current|*CURRENT\n TYPE=SUBROUTINE\n", "3:2 SYN001"),
    ("geometric_sets|*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL, EIYY=a\n 2E11, 8E10, 0.3, 0.2, 7850\n", "4:16 SYN001"),
    ("geometric_sets|*GEOMETRIC SETS\n SET=ALL, E=a\n 1, 1, 1, 1, 1, 1, 0.1, 0.2, 0.2\n", "3:13 SYN001"),
    ("restart|*RESTART\n LAST=a, TYPE=SIDEWAYS\n", "3:15 SYN005"),
    ("restart|*RESTART\n LAST=a, TYPE=CONTINUATION, OPTION=PREPEND\n", "3:36 SYN005"),
    ("restart|*RESTART\n LAST=a, TYPE=DYNAMIC/STATIC\n", ""),
    ("seabed_profile|*SEABED PROFILE\n TYPE=3D\n INTERPOLATION=LINEAR, DIRECTION=5\n FILE=a.fcsbd\n", "2:1 SYN001"),
    ("para_seabed|*PARA SEABED\n DATA1=ALL\n DATA2=4\n", "4:8 SBD010"),
    ("stress_properties|*PROPERTIES\n SET=ALL\n 0.3, , , , , -0.01\n", "4:15 SBD010"),
    ("stress_properties|*PROPERTIES\n 0.3\n", "3:2 SYN001"),
    ("stress_properties|*PROPERTIES\n SET=ALL\n , 0.2\n", ""),
    ("clear_database|*DATABASE\n DATABASE_3=a\n", "3:2 SYN004"),
    ("scatter_diagram|*SCATTER DIAGRAM\n REFERENCE=2, 8, 9\n", "3:2 SYN001"),
    ("scatter_diagram|*SCATTER DIAGRAM\n REFERENCE=2, 8, 9, FILE=a\n 2, 0, 9\n", "4:5 SBD010"),
    ("scatter_options|*OPTIONS\n OVERWRITE DATA=MAYBE\n", "3:17 SYN005"),
    ("viscous_drag|*VISCOUS DRAG\n FLOATING BODY=a\n TYPE=MATRIX\n OPTION=TOTAL\n", "5:9 SYN005"),
    ("viscous_drag|*VISCOUS DRAG\n FLOATING BODY=a\n TYPE=MATRIX\n 1, 2, 3, 4, 5, 6\n", "3:2 SYN001"),
    ("tolerance|*TOLERANCE\n ANALYSIS=FREQUENZY\n 0.025\n", "3:11 SYN005"),
    ("tolerance|*TOLERANCE\n ANALYSIS=FREQUENCY\n 0.025, 30, 1.8\n", "4:13 SBD010"),
    ("tolerance|*TOLERANCE\n ANALYSIS=FREQUENCY\n 0.025, 30, 0.8, 1\n", "4:2 SYN003"),
    ("tolerance|*TOLERANCE\n 0.001, 20, 10, -0.01\n", "3:17 SBD010"),
    ("tolerance|*TOLERANCE\n 0.001\n 0.002\n", "2:1 SYN001"),
    ("tolerance|*TOLERANCE\n ANALYSIS=STATIC/TIME\n , , , , 50.0\n ANALYSIS=FREQUENCY\n 0.03\n", ""),
    ("label|*LABEL\n TYPE=NOD\n 1, LABEL=a\n", "3:7 SYN005"),
    ("label|*LABEL\n 1, LABEL=a\n", "2:1 SYN001"),
    ("label|*LABEL\n TYPE=NODE\n 1\n", "3:2 SYN001"),
    ("time_stepping|*TIME STEPPING\n TYPE=HILBER-HUGHES\n 0.1\n", "4:2 SBD010"),
    ("time|*TIME\n STEP=FIXED\n 0, 100, -0.1\n", "4:10 SBD010"),
    ("time|*TIME\n STEP=VARIABLE\n 0, 100\n", "2:1 SYN001"),
    ("time|*TIME\n STEP=VARIABLE\n 0, 100, 10\n 0.1, 0.01, 1\n 0.1, 0.01, 1\n", "2:1 SYN001"),
    ("time|*TIME\n STEP=FIXED\n 0, 100\n 0.1, 0.01, 1\n", "2:1 SYN001"),
    ("time|*TIME\n STEP=FIXT\n 0, 100\n", "3:7 SYN005"),
    ("summary_time|*TIME\n START=-2\n", "3:8 SBD010"),
    ("non_linear_static|*NON LINEAR STATIC\n 0, 0.001, 20\n", "3:2 SBD010"),
    ("non_linear_static|*NON LINEAR STATIC\n 5.5\n", "3:2 SYN002"),
    ("vessel|*VESSEL\n VESSEL=a\n INITIAL POSITION=1, 2\n", "4:19 SYN003"),
    ("vessel|*VESSEL\n VESSEL=a\n", "3:2 SYN014"),
    ("vessel_integrated|*VESSEL,INTEGRATED\n VESSEL=a\n INITIAL POSITION=1, x.0, 2\n", "4:22 SYN002"),
    ("vessel_velocity|*VESSEL VELOCITY\n VESSEL=a, AXIS=GLOBE\n 1\n", "3:17 SYN005"),
    ("vessel_timetrace|*VESSEL TIMETRACE\n VESSEL=a\n", "3:2 SYN014"),
    ("rao|*RAO\n VESSEL=a\n HEADING=200\n 0.1\n 1, 1, 1, 1, 1, 1\n 1, 1, 1, 1, 1, 1\n", "4:10 SBD010"),
    ("rao|*RAO\n VESSEL=a\n HEADING=0\n 0.1\n 1, 1, 1, 1, 1\n 1, 1, 1, 1, 1, 1\n", "6:2 SYN003"),
    ("rao|*RAO\n VESSEL=a\n LAYOUT=LINE\n 0, 0.1, 1, 2\n", "5:2 SYN003"),
    ("offset|*OFFSET\n VESSEL=a\n OFFSET=1, two\n", "4:12 SYN002"),
    ("drift|*DRIFT\n VESSEL=a, TYPE=SINUSOIDAL\n 7, 1, 0, 100\n", "4:2 SBD010"),
    ("drift|*DRIFT\n VESSEL=a, TYPE=SINUSOIDAL\n 2, 1, 0\n", "4:2 SYN003"),
    ("database|*DATABASE\n TIME=SELECTED\n", "2:1 SYN001"),
    ("database|*DATABASE\n TIME=ALL\n 0, 1\n", "2:1 SYN001"),
    ("wave_regular|*WAVE-REGULAR\n 1.O, 9\n", "3:2 SYN002"),
    ("wave_regular|*WAVE-REGULAR\n 1, 0\n", "3:5 SBD010"),
    ("wave_stokes|*WAVE-STOKES\n 6\n", "3:2 SYN003"),
    ("wave_stokes|*WAVE-STOKES\n 6, 12, 0, 0, 12\n", ""),
    ("wave_time_history|*WAVE-TIME-HISTORY\n FILE=a\n 0, 0, 0, 1, ENSEMBLES=0\n", "4:24 SBD010"),
    ("wave_time_history|*WAVE-TIME-HISTORY\n FILE=a\n 0, 0, 0, 1\n", "2:1 SYN001"),
    ("wave_jonswap|*WAVE-JONSWAP\n FREQUENCY=AREA, SPEC=HSTP\n 4, 11, 0.01, 0.3, 80, 0\n", "4:24 SBD010"),
    ("wave_jonswap|*WAVE-JONSWAP\n FREQUENCY=GP, SPEC=HSTZ\n 4, 11, 0.01\n", "4:2 SYN003"),
    ("wave_deans|*WAVE-DEANS\n 6, 12, 0, 0, 0\n", "3:15 SBD010"),
    ("wave_deans|*WAVE-DEANS\n OPTION=SUPERPOSE\n 6, 12, 180, 0.5, 15, 100, 5, 3, 12\n", ""),
    ("wave_ochi_hubble|*WAVE-OCHI-HUBBLE\n FREQUENCY=GP\n 3, 14, 3, 2, 8, 1.5, 0.35, x, 1\n", "4:29 SYN002"),
    ("wave_torsethaugen|*WAVE-TORSETHAUGEN\n FREQUENCY=AREA\n 4, 11, 0.01, 0.35, 80\n", "4:2 SYN003"),
    ("wave_user_defined|*WAVE-USER-DEFINED\n FREQUENCY=GP\n 1.05, 1\n 0.05, 0\n -0.1, 2\n", "6:2 SBD010"),
    ("wave_user_defined|*WAVE-USER-DEFINED\n 1.05, 1\n", "3:2 SYN001"),
    ("moonpool|*MOONPOOL\n VESSEL=a\n 90, 0, 0, 0, -9\n", "4:15 SBD010"),
    ("vector|*VECTOR\n VECTOR=a\n 0, north\n", "4:5 SYN002"),
    ("local_axis_system|*LOCAL AXIS SYSTEM\n NAME=a\n 0, 1, 0, 1, 0, 0, 5\n", "4:2 SYN003"),
    ("axis_vector|*AXIS/VECTOR\n AXIS=a\n 10, LOCAL_X=11\n", "4:6 SYN004"),
    ("collate_plot_axes|*COLLATE PLOT AXES\n Heading, north\n", "3:11 SYN002"),
    ("collate|*COLLATE\n TITLE=a\n MIN=0, STDDEV=-1\n", "4:16 SBD010"),
    ("current|*CURRENT\n TYPE=PIECEWISE\n", "3:7 SYN005"),
    ("current|*CURRENT\n TYPE=UNIFORM\n 0.5, north\n", "4:7 SYN002"),
    ("current|*CURRENT\n TYPE=UNIFORM\n 0.5, 90\n 0.7, 90\n", "5:2 SYN001"),
    ("current_coeff|*CURRENT COEFF\n MORED VESSEL\n 0, 1, 2, 3\n", "3:2 SYN005"),
    ("lines_pip|*LINES PIP\n PRIMARY=a, SECONDARY=b\n BULKHEDS, 1\n", "4:2 SYN005"),
    ("current_coeff|*CURRENT COEFF\n FLOATING BODY=a\n 0, 1, 2\n", "4:2 SYN003"),
    ("current_coeff|*CURRENT COEFF\n MOORED VESSEL\n 0, 1, 2\n", "4:2 SYN003"),
    ("wind_coeff|*WIND COEFF\n FLOATING BODY=a\n 0, 1, 2, x\n", "4:11 SYN002"),
    ("moments|*MOMENTS\n 1, 2, 0\n", "3:5 SBD010"),
    ("contact_modelling|*CONTACT MODELLING\n RAMP=-1\n", "3:7 SBD010"),
    ("wave_spectrum|*WAVE SPECTRUM\n TYPE=JONSWAP, OPTION=TX\n", "3:23 SYN005"),
    ("td_options|*TD OPTIONS\n 1, ENSEMBLES=1\n", "3:15 SBD010"),
    ("source_type|*SOURCE TYPE\n SOURCE=DATABSE\n", "3:9 SYN005"),
    ("shear7_current|*CURRENT\n PROBABILITY=2\n 0, 1\n 2, 3\n", "3:14 SBD010"),
    ("internal_fluid|*INTERNAL FLUID\n SET=ALL\n 1, -2\n", "4:5 SBD010"),
    ("internal_fluid|*INTERNAL FLUID\n SET=ALL\n 1, 2, CORIOLIS=NO\n", "4:17 SYN005"),
    ("moment_curvature|*MOMENT-CURVATURE\n CURVE=a\n 0, 0\n 1\n", "5:2 SYN003"),
    ("force_strain|*FORCE-STRAIN\n 0, 0\n", "3:2 SYN001"),
    ("torque_twist|*TORQUE-TWIST\n CURVE=a\n 0, 0\n one, 1\n", "5:2 SYN002"),
    ("stress_strain_direct|*STRESS/STRAIN DIRECT\n CURV=a\n", "3:2 SYN004"),
    ("damper_data|*DAMPER DATA\n NAME=a, VARIABLE=SPEED\n 0, 1\n 1, 2\n", "3:19 SYN005"),
    ("drag_lift|*DRAG LIFT\n CURVE=a\n 0, 1\n 1, x\n", "5:5 SYN002"),
    ("cable|*CABLE\n 1, 1, 2, -5\n", "3:11 SBD010"),
    ("cable|*CABLE\n 1, 2\n", "3:2 SYN003"),
    ("node_curvilinear|*NODE,CURVILINEAR\n 2, 1, 3, 4\n", "3:2 SYN003"),
    ("hydrodynamic_sets|*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n -1, 0\n", "4:2 SBD010"),
    ("mass|*MASS\n 1, 5, TYPE=MAS\n", "3:13 SYN005"),
    ("element_set_post|*ELEMENT SET\n 1, 2\n", "3:2 SYN001"),
    ("clear_element_sets|*ELEMENT SETS\n 1, 2\n", "2:1 SYN001"),
    ("spring_element|*SPRING ELEMENT\n ELEMENT=1\n TYPE=LINEAR\n", "3:2 SYN001"),
    ("spring_element|*SPRING ELEMENT\n ELEMENT=1\n TYPE=LINEAR\n -5\n", "5:2 SBD010"),
    ("node_spring|*NODE SPRING\n 1, 7, 5\n", "3:5 SBD010"),
    ("hinge|*HINGE\n 1, STIFFNESS=-2\n", "3:15 SBD010"),
    ("flexjoint|*FLEXJOINT\n ELEMENT=1\n TYPE=NONLINEAR\n 1, x\n 2, 3\n", "5:5 SYN002"),
    ("drag_chain|*DRAG CHAIN\n 1, 0, 5\n", "3:5 SBD010"),
    ("added_mass|*ADDED MASS\n FLOATING BODY=a\n TYPE=CONSTANT\n 1, 2, 3\n", "5:2 SYN003"),
    ("added_mass|*ADDED MASS\n FLOATING BODY=a\n TYPE=CONSTANT\n 1, 2, 3, 4, 5, 6\n", "4:2 SYN001"),
    ("radiation_damping|*RADIATION DAMPING\n FLOATING BODY=a\n TYPE=CONST\n", "4:7 SYN005"),
    ("pip_connection|*PIP CONNECTION\n 1, 2, STIFNESS=3\n", "3:8 SYN004"),
    ("pip_section|*PIP SECTION\n OUTER=a\n", "3:2 SYN001"),
    ("pip_stiffness|*PIP STIFFNESS\n CURVE=a\n 0, 0\n -1, 1\n", "5:2 SBD010"),
    ("lines_pip|*LINES PIP\n PRIMARY=a, SECONDARY=b, TYPE=PIP\n STIFFNESS=x, 1\n", "4:12 SYN002"),
    ("auxiliary|*AUXILIARY\n 1, 2\n", "3:2 SYN001"),
    ("node_auxiliary|*NODE,AUXILIARY\n 1, 2\n", "3:2 SYN003"),
    ("element_auxiliary|*ELEMENT,AUXILIARY\n 1, 2\n", "3:2 SYN003"),
    ("panel_auxiliary|*PANEL,AUXILIARY\n 1, 2, 3, x\n", "3:11 SYN002"),
    ("body_integrated|*BODY,INTEGRATED\n BODY=a\n LOCATION=1, 2, 3\n PROFILE=BOX\n", "5:10 SYN005"),
    ("criteria|*CRITERIA\n CRITERION=TENSION, MONITOR=1, TARGET=2\n VARIABLE=NODE\n", "2:1 SYN001"),
    ("excel_variations|*EXCEL VARIATIONS\n EXCEL=a\n", "2:1 SYN001"),
    ("para_force|*PARA FORCE\n DATA1=1\n DATA2=4\n DATA3=a\n", "4:8 SBD010"),
    ("para_force_envelope|*PARA FORCE ENVELOPE\n DATA1=ALL\n", "3:2 SYN014"),
    ("para_reaction|*PARA REACTION\n DATA1=1\n DATA2=7\n", "4:8 SBD010"),
    ("para_kinematic|*PARA KINEMATIC\n DATA1=1\n DATA2=1\n DATA3=5\n", "5:8 SBD010"),
    ("para_angle_element|*PARA ANGLE ELEMENT\n DATA1=1\n DATA2=two words, 3\n", "4:8 SYN003"),
    ("code_checking_timetrace|*TIMETRACE\n SET=ALL\n 1, 1, OUTPUT=ASD\n", "4:15 SYN005"),
]


@pytest.mark.parametrize(("case", "expected"), FAULTS)
def test_a_wrong_value_is_told_with_its_place(case: str, expected: str) -> None:
    rule, lines = case.split("|")
    found = [f"{line}:{column} {code}" for _, code, line, column in all_reported(in_section(rule, lines))]
    assert expected in found or (expected == "" and found == [])


def test_every_keyword_that_is_new_has_a_wrong_value() -> None:
    tried = {case.partition("|")[0] for case, _ in FAULTS}
    opaque = {"load", "timetrace", "analysis_type", "units"}
    of_manual = {rule for rule, block in BLOCKS.items() if not block.facts.extension}
    older = {
        *("boundary", "combinations", "elastic_surface", "element", "element_sets", "embedment", "friction", "node"),
        *("line_path_sections", "line_section_groups", "ocean", "p_y", "parameters"),
        *("rigid_surface", "seabed_properties", "seabed_stiffness", "t_z", "variation"),
    }
    assert of_manual - tried == opaque | older


def test_a_sea_keeps_its_frequencies_until_they_are_given_again() -> None:
    lines = "*WAVE-TORSETHAUGEN\n FREQUENCY=GP\n 4, 11, 0.3, 1.05, 1\n 5, 12, 0.3, 1.05, 1\n"
    first, second = cast("list[dict[str, Any]]", written("wave_torsethaugen", lines)["seas"])
    assert first == {"frequency": "GP", "progression": first["progression"]}
    assert second == {"progression": {"height": 5, "period": 12, "cutoff": 0.3, "factor": 1.05, "directions": 1}}


def test_a_wave_of_many_periods() -> None:
    lines = "*WAVE-REGULAR\n OPTION=MANY\n 1, 5, 20, 16\n 1, 90, 5, 20, 16\n OPTION=ONE\n 1, 9, 90\n"
    band = {"amplitude": 1.0, "least": 5.0, "largest": 20.0, "number": 16}
    assert written("wave_regular", lines) == {
        "waves": [
            {"option": "MANY", "band": band},
            {"directed_band": {**band, "direction": 90.0}},
            {"option": "ONE", "wave": {"amplitude": 1.0, "period": 9.0, "direction": 90.0}},
        ]
    }


def test_a_sea_goes_on_in_the_form_of_the_line_before() -> None:
    rest = "0.3, 80, 1, 180.0\n"
    lines = f"*WAVE-JONSWAP\n FREQUENCY=AREA, SPEC=HSTZ\n 4, 9, 0.01, {rest} 3, 8, 0.01, {rest}"
    first, second = only("wave_jonswap", lines + " FREQUENCY=GP\n 0.1, 0.008, 3.3, 0.3, 1.02, 1\n").seas[:2]  # type: ignore[attr-defined]
    assert (first.area_height.period, second.area_height.period) == (9.0, 8.0)
    other = only("wave_jonswap", "*WAVE-JONSWAP\n FREQUENCY=AREA, SPEC=HSTPGAMMA\n 4, 9, 3.3, 0.01, 0.3\n")
    assert not is_read(other)


def test_the_operators_of_a_vessel_in_both_layouts() -> None:
    six = "1, 0, 0, 0, 0, 2"
    by_heading = f"*RAO\n VESSEL=a\n HEADING=0\n 0.1\n {six}\n {six}\n 0.2\n {six}\n {six}\n HEADING=90\n"
    (vessel,) = only("rao", by_heading).vessels  # type: ignore[attr-defined]
    assert [len(heading.frequencies) for heading in vessel.headings] == [2, 0]
    assert vessel.headings[0].frequencies[1].phases.pitch == 2.0
    by_line = f"*RAO\n VESSEL=a\n LAYOUT=LINE\n 0, 0.1, {six}, {six}\n 90, 0.1, {six}, {six}\n"
    (vessel,) = only("rao", by_line).vessels  # type: ignore[attr-defined]
    assert vessel.lines.values.shape == (2, 14)


def test_a_key_that_stands_twice_on_a_line_has_a_field_for_each() -> None:
    lines = "*PIP CONNECTION\n GEN=1, 9, 2, GEN=101, 109, 2, CURVE=a\n GEN=1, 9, SET=b, STIFFNESS=2, AXIAL_STIFF=3\n"
    assert written("pip_connection", lines)["connections"] == [
        {"generate": [1, 9, 2], "second": [101, 109, 2], "curve": "a"},
        {"generate": [1, 9], "set": "b", "stiffness": 2.0, "axial_stiffness": 3.0},
    ]
    assert faults(in_section("pip_connection", "*PIP CONNECTION\n GEN=1, 2, GEN=3, 4, GEN=5, 6\n"))[0].startswith(
        "3:22 SYN001 GEN= is given twice"
    )


@pytest.mark.parametrize("title", ["Anchor, axial = EA e, =[x]", "12", '"a, b"', "Heave", "C 1"])
def test_a_title_is_the_rest_of_its_line(title: str) -> None:
    lines = f"*PARA FORCE\n TITLE={title}\n DATA1=1\n DATA2=1\n DATA3=TENSION\n"
    deck = deck_of(f"$SUMMARY POSTPROCESSING\n{lines}")
    assert deck.problems == []
    assert written("para_force", lines)["title"] == title
    held(deck)

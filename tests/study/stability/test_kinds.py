"""Every kind of contact: its worked numbers, and steps on the evaluator 1 % below and above the critical one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact import ContactModel
from mudline.contact.arrays import FloatArray
from mudline.contact.stiffest import CRITICAL_OMEGA_DT, critical_step
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from mudline.scene.model import Scene
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.motion import Forces, History, Motion
from mudline.study.schemes import SCHEMES
from mudline.study.stability.contacts import Contact, find_contacts
from mudline.study.stability.critical import BOUNDED, GROWS, measure
from tests.builders.scenes import legal_scene

MASS = 7850.0 * 0.25 * np.pi * (0.3**2 - 0.25**2)
WEIGHT = 9.81 * (MASS - 1025.0 * 0.25 * np.pi * 0.3**2)
_HEAD = SAMPLE_TEXT.partition("*SEABED PROPERTIES")[0]
ELASTIC = f"{_HEAD}*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50.0E3\n"
"""A linear seabed below 10 elements of 2 m: central difference alone allows 0.116 s."""

FRICTION = 495.0**2 * MASS
"""Per node at the ends of the line, which carry 1 m of pipe: omega = 495 rad/s there."""

KINDS = {
    "normal": ELASTIC,
    "friction": f"{ELASTIC}*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.5, 0.5\n STIFFNESS={FRICTION!r}\n",
    "lateral": f"{ELASTIC} LATERAL=2.0E5\n",
    "unloading": f"{ELASTIC}*SEABED UNLOADING\n SET=ALL\n STIFFNESS=4.0E5\n",
    "suction spring": f"{ELASTIC} SUCTION=8.0E4, 0.02\n",
    "suction mobilisation": f"{ELASTIC}*SEABED SUCTION\n SET=ALL\n FORCE=754.0, 0\n DEPTH=1.0E-3, 0\n"
    " CUTOFF=0.01, 0.5\n REGULARISATION=1.0E3\n",
    "suction damping": f"{ELASTIC}*SEABED SUCTION\n SET=ALL\n COHESION=5.0E2\n",
    "nodal": f"{ELASTIC}*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=1.0E6\n",
}


def of_kind(scene: Scene, kind: str) -> Contact:
    return next(one for one in find_contacts(scene)[0] if one.oscillation.kind == kind)


@pytest.mark.parametrize(
    ("kind", "omega", "rate"),
    [
        ("normal", math.sqrt(50e3 / MASS), 0.0),
        ("friction", 495.0, 0.0),
        ("lateral", math.sqrt(2e5 / MASS), 0.0),
        ("unloading", math.sqrt(4e5 / MASS), 0.0),
        ("suction spring", math.sqrt(8e4 / MASS), 0.0),
        ("suction mobilisation", math.sqrt(754.0 / (0.01 * 1e-3) / MASS), 0.0),
        ("suction damping", 0.0, 1.82 * 1.12 * 0.3**0.82 * 500.0 * 1e-3**-0.82 / MASS),
        ("nodal", math.sqrt(1e6 / MASS), 0.0),
    ],
)
def test_worked_numbers_and_steps_one_percent_off(kind: str, omega: float, rate: float) -> None:
    scene = legal_scene(KINDS[kind])
    one = of_kind(scene, kind)
    assert one.omega == pytest.approx(omega, rel=1e-9)
    assert one.rate == pytest.approx(rate, rel=1e-9)
    assert one.mass == pytest.approx(MASS)
    found = measure(scene, one, SCHEMES["central-difference"])
    assert (found.below, found.above) == (BOUNDED, GROWS)
    assert found.predicted == pytest.approx(4.0 / (rate + math.hypot(rate, 2.0 * omega)))
    assert measure(scene, one, SCHEMES["velocity-verlet"]).as_predicted


def test_friction_and_suction_ask_for_less_than_the_normal_law() -> None:
    """The seabed alone allows 0.116 s; friction of 495 rad/s 0.004 s; the ramp and the damping of suction 3 ms."""
    steps = {kind: of_kind(legal_scene(KINDS[kind]), kind).critical_step("velocity-verlet") for kind in KINDS}
    assert steps["normal"] == pytest.approx(0.11646, rel=1e-4)
    assert steps["friction"] == pytest.approx(2.0 / 495.0)
    assert steps["suction damping"] == pytest.approx(0.00155, rel=0.01)
    assert steps["suction mobilisation"] == pytest.approx(0.003, rel=1e-3)
    sample = of_kind(sample_scene(), "suction mobilisation")
    assert sample.critical_step("central-difference") == pytest.approx(0.003128, rel=1e-3)


def test_the_rule_sees_friction() -> None:
    text = f"{KINDS['friction']}$LOAD CASE\n*TIME\n STEP=FIXED\n 0.0, 120.0, 0.004656, 24.0\n"
    (found,) = lint_bytes(text.encode(), "deck.keyxm", select(["STB002"]))
    assert (
        "omega dt = 2.3 on the stiffest contact (friction on ALL, node 1, line 28, omega = 495 rad/s)" in found.message
    )
    assert "central difference fails; give a step of 0.00101 or less" in found.message


def test_the_rule_says_what_damping_asks_of_central_difference() -> None:
    text = SAMPLE_TEXT + "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.1, 24.0\n"
    (found,) = lint_bytes(text.encode(), "deck.keyxm", select(["STB002"]))
    step = of_kind(sample_scene(), "suction damping").critical_step("central-difference")
    assert f"central difference needs {math.floor(step * 1e6) / 1e6:.3g} or less for suction damping" in found.message
    assert "give a step of 0.0163 or less" in found.message


class _Line:
    """The whole line of a deck at the evaluator, all nodes free along X, under the load that holds it at a depth."""

    def __init__(self, scene: Scene, depth: float) -> None:
        self._model = ContactModel(scene.contact_input(), backend="numpy")
        self._points = np.array(scene.coordinates)
        self._points[:, 0] = -depth
        half = 0.5 * scene.length * scene.mass_per_length
        self.mass: FloatArray = np.zeros(len(self._points))
        for end in scene.element_nodes.T:
            np.add.at(self.mass, end, half)
        self._load = self._at(np.zeros(len(self.mass)))

    def _at(self, position: FloatArray) -> FloatArray:
        points = self._points.copy()
        points[:, 0] += position
        velocities = np.zeros_like(points)
        found: FloatArray = self._model.step(points, velocities, self._model.initial_state())[0].reaction[:, 0]
        return found

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        none = np.zeros(len(velocity))
        return Forces(self._at(position) - self._load, none, none, history)


@pytest.mark.parametrize(("share", "grows"), [(0.99, False), (1.01, True)])
def test_a_whole_line_has_the_critical_step_of_its_stiffest_nodes(share: float, grows: bool) -> None:
    """Nodes that share elements oscillate together; none of their modes is faster than the printed frequency."""
    scene = sample_scene()
    line = _Line(scene, 0.0015)
    dt = share * of_kind(scene, "normal").critical_step("central-difference")
    motion = Motion.start(line, 1e-9 * np.cos(np.arange(len(line.mass))), np.zeros(len(line.mass)))
    for _ in range(150):
        motion = SCHEMES["central-difference"].step(line, motion, dt).motion
    assert bool(np.abs(motion.position).max() > 1e-7) == grows


def test_a_node_between_two_laws_carries_both_of_their_elements() -> None:
    """One stiff element of three: its nodes carry the mass of the soft ones beside it too."""
    text = ELASTIC.replace("SET=Clay\n GEN=1, 7", "SET=Stiff\n 5").replace(" SET=Sand\n GEN=8, 10\n", "")
    text += " SET=Stiff\n STIFFNESS=1.0E6\n"
    found = {one.name: one for one in find_contacts(legal_scene(text))[0]}
    assert found["linear on Stiff"].stiffness == pytest.approx(0.5 * (50e3 + 1e6))
    assert found["linear on ALL"].stiffness == pytest.approx(50e3)


@pytest.mark.parametrize(
    ("exponents", "what"),
    [((1.5, 0.1), "suction damping on ALL"), ((0.5, 0.2), "suction mobilisation on ALL")],
)
def test_suction_that_grows_with_the_velocity_is_named(exponents: tuple[float, float], what: str) -> None:
    force, depth = exponents
    text = f"{ELASTIC}*SEABED SUCTION\n SET=ALL\n FORCE=1000, {force}\n DEPTH=0.1, {depth}\n"
    found, unknown = find_contacts(legal_scene(text))
    assert [one.what for one in unknown] == [what]
    assert what not in {one.name for one in found}


class _Damped:
    """x'' = -omega^2 x - gamma x', from unit position, velocity and acceleration side by side."""

    def __init__(self, frequency: float, rate: float) -> None:
        self._frequency, self._rate = frequency, rate
        self.mass: FloatArray = np.ones(3)

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        stiffness = self._frequency**2
        force = -stiffness * position - self._rate * velocity
        return Forces(force, np.full(3, -stiffness), np.full(3, -self._rate), history)


def radius(scheme: str, frequency: float, rate: float, dt: float) -> float:
    """Spectral radius of the matrix that takes position, velocity and acceleration over one step."""
    unit, system = np.eye(3), _Damped(frequency, rate)
    explicit_rate = scheme in {"rk4", "rk2", "forward-euler"}  # their acceleration is that of position and velocity
    acceleration = -(frequency**2) * unit[0] - rate * unit[1] if explicit_rate else unit[2]
    step = SCHEMES[scheme].step(system, Motion(unit[0], unit[1], acceleration, np.zeros(3), None), dt).motion
    matrix = np.array([step.position, step.velocity, step.acceleration])
    return float(np.abs(np.linalg.eigvals(matrix[:2, :2] if explicit_rate else matrix)).max())


@pytest.mark.parametrize("scheme", CRITICAL_OMEGA_DT)
@given(angle=st.floats(0.0, 1.0), share=st.floats(0.01, 0.999))
def test_critical_steps_with_damping_are_where_the_matrix_of_a_step_begins_to_grow(
    scheme: str, angle: float, share: float
) -> None:
    """From springs alone, at 0, to dampers alone, at 1."""
    frequency, rate = math.cos(0.5 * math.pi * angle), 2.0 * math.sin(0.5 * math.pi * angle)
    dt = critical_step(scheme, frequency, rate)
    assert radius(scheme, frequency, rate, share * dt) <= 1.0 + 1e-9
    assert radius(scheme, frequency, rate, 1.01 * dt + 1e-3) > 1.0


def test_implicit_schemes_and_nothing_at_all_have_no_critical_step() -> None:
    assert critical_step("newmark", 1.0, 1.0) == critical_step("rk4", 0.0, 0.0) == math.inf
    assert critical_step("rk4", 1.0) == pytest.approx(2.0 * math.sqrt(2.0))
    assert critical_step("rk2", 1.0) == critical_step("forward-euler", 1.0) == 0.0

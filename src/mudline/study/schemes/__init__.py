"""Time integration schemes: a table of coefficients each, and one stepping engine for each family.

* explicit: `kick_drift` (central difference, velocity Verlet) and `runge_kutta` (forward Euler, RK2, RK4);
* implicit, linear one-step: `one_step` (Newmark, HHT, generalised-alpha, backward Euler).

They step k systems of one degree of freedom side by side, so that an ensemble costs little more than one run.
"""

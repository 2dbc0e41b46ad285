"""Fits a fabric to a bending loop in arrays, and hangs a towel of the fabric."""

import numpy as np

import drape

# A loop of the KES bending test in SI, of a fabric with a rigidity of 1.2e-5 N·m and friction: from 0 to
# 250 1/m, back to -250 1/m, and to 0. The friction approaches its plateau over 4 1/m of curvature.
RIGIDITY, PLATEAU, LENGTH = 1.2e-5, 6e-4, 4.0
curvature = np.concatenate([np.arange(0, 250, 2), np.arange(250, -250, -2), np.arange(-250, 1, 2)]).astype(float)
friction = np.zeros_like(curvature)
for i, step in enumerate(np.diff(curvature)):
    end = np.copysign(PLATEAU, step)
    friction[i + 1] = end + (friction[i] - end) * np.exp(-abs(step) / LENGTH)
moment = RIGIDITY * curvature + friction

fit = drape.fit([drape.Curve("bending", "warp", curvature, moment)], bending="first-order")
fitted = fit.params["warp.bending.rigidity"].value
print(f"rigidity {fitted:.4e} N·m; {len(fit.assumed)} values were not measured")
assert abs(fitted / RIGIDITY - 1) < 1e-6, fitted

# A towel of 20 cm x 30 cm hangs from its upper edge, and swings for a fifth of a second.
scene = drape.SceneBuilder(name="towel", spacing=0.02, time={"step": 0.005, "end": 0.2})
scene.fabric("plain", fit).panel("towel", "plain", rectangle=[0.2, 0.3], turn=[-90, 0, 0])
scene.pin("towel", points=[[0, 0.3], [0.2, 0.3]])
simulation = drape.Simulation(scene.scene())
start = simulation.positions.copy()
while not simulation.step().finished:
    pass
lowest = float((simulation.positions - start)[:, 1].min())
print(f"after {simulation.time:.2f} s the cloth hangs {-1e3 * lowest:.0f} mm lower")
# Nothing falls faster than free.
assert 0.05 < -lowest < 0.5 * 9.81 * 0.2**2 + 1e-9

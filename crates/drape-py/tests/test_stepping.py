"""Simulations step by step are those of a run."""

import threading

import numpy as np
import pytest

import drape


def test_steps_come_to_the_state_of_a_run(towel):
    scene = drape.Scene.read(towel)
    run = scene.run(threads=1)
    simulation = drape.Simulation(scene, threads=2)
    assert simulation.time == 0
    steps = 0
    while True:
        step = simulation.step()
        steps += 1
        if step.finished:
            break
    assert steps == run.summary["steps"]
    assert simulation.time == step.time == pytest.approx(0.1)
    assert simulation.state_hash() == run.summary["state_hash"]
    assert simulation.energy() == run.summary["energy"]


def test_arrays_have_shapes_and_never_change(towel):
    scene = drape.Scene.read(towel)
    simulation = drape.Simulation(scene)
    n = scene.particles
    start = simulation.positions
    kept = start.copy()
    assert start.shape == simulation.velocities.shape == (n, 3) and start.dtype == np.float64
    assert simulation.positions is start
    with pytest.raises(ValueError):
        start[0, 0] = 1.0
    step = simulation.step()
    assert np.array_equal(start, kept) and not np.array_equal(simulation.positions, start)
    speeds = np.linalg.norm(simulation.velocities, axis=1)
    assert speeds.max() == pytest.approx(step.speed_max)
    assert simulation.triangles.shape[1] == 3 and simulation.coordinates.shape == (n, 2)
    assert simulation.panels == scene.panels
    del simulation
    assert np.array_equal(start, kept)


def test_the_pins_carry_the_weight_of_cloth_at_rest(towel):
    text = towel.read_text().replace("end = 0.1", "end = 20").replace("0.01", "0.02")
    towel.write_text(text + "settle = { speed = 0.002 }\n")
    simulation = drape.Simulation(drape.Scene.read(towel))
    while not simulation.step().finished:
        pass
    forces, moments = simulation.pin_loads()
    assert forces.shape == moments.shape == (1, 3)
    # The load is that of the cloth with the particles that the pin holds, or without them.
    weight = 0.1056 * 0.2 * 0.3 * 9.81
    assert 0.9 * weight < abs(forces[0, 1]) < 1.1 * weight


def test_a_simulation_is_stepped_by_one_thread_at_a_time(towel):
    simulation = drape.Simulation(drape.Scene.read(towel))
    failures = []

    def step():
        try:
            for _ in range(10):
                simulation.step()
        except RuntimeError as error:
            failures.append(error)

    threads = [threading.Thread(target=step) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("borrowed" in str(error) for error in failures)
    assert np.isfinite(simulation.positions).all()

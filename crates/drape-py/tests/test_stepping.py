"""Simulations step by step are those of a run."""

import re
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


def test_no_array_can_be_made_writable_by_accident(towel, tmp_path):
    scene = drape.Scene.read(towel)
    simulation, twin = drape.Simulation(scene), drape.Simulation(scene)
    told = []
    run = scene.run(tmp_path / "own", until=0.02, on_frame=lambda frame: told.append(frame.positions))
    curve = drape.fit(towel.parent / "fabrics/cupro-weave").curves[0]
    arrays = [simulation.positions, simulation.velocities, simulation.triangles, simulation.coordinates, *told]
    arrays += [run.frames[0], run.times, run.triangles, run.coordinates, curve["measured"], curve["fitted"]]
    for array in arrays:
        kept = array.copy()
        with pytest.raises(ValueError):
            array.flags.writeable = True
        with pytest.raises(ValueError):
            array.setflags(write=True)
        with pytest.raises(ValueError):
            array[...] = 0
        with pytest.raises(ValueError):
            np.asarray(array).reshape(-1)[0] = 1
        assert np.array_equal(array, kept) and array.flags.aligned and array.flags.c_contiguous
    # What is not the simulation's may be written to, and does not reach it.
    for forces in simulation.pin_loads():
        forces[...] = 7
    for step in range(5):
        simulation.step()
        twin.step()
    assert simulation.state_hash() == twin.state_hash()


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
        except drape.UsageError as error:
            failures.append(error)

    threads = [threading.Thread(target=step) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("one thread uses it at a time" in str(error) for error in failures)
    assert np.isfinite(simulation.positions).all()


def push(simulation, acceleration):
    """Forces that give each particle of a cloth of 0.1056 kg/m² an acceleration, in m/s²."""
    (x, y), triangles = simulation.coordinates.T, simulation.triangles
    corners = np.stack([x[triangles], y[triangles]], axis=-1)
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.zeros(len(x))
    own = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) / 6
    np.add.at(areas, triangles.ravel(), np.repeat(own, 3))
    return 0.1056 * areas[:, None] * np.asarray(acceleration)


def test_a_constant_force_is_a_fall_in_its_direction(towel):
    text = towel.read_text().replace('pin = [{ panel = "towel", edge = "top" }]', "gravity = [0, 0, 0]")
    # What the solver leaves in a step pushes the cloth aside: it leaves little here.
    towel.write_text(text + "solver.tolerance = 1e-6\n[air]\ndensity = 0\n")
    simulation = drape.Simulation(drape.Scene.read(towel))
    start = simulation.positions
    forces = push(simulation, [0.0, 1.0, 3.0])
    for _ in range(50):
        simulation.step(forces=forces)
    # The sums of triangles give the masses only on the whole: the mean falls as a point.
    t = simulation.time
    masses = np.linalg.norm(forces, axis=1)
    moved = np.average(simulation.positions - start, axis=0, weights=masses)
    assert moved == pytest.approx([0, 0.5 * t * t, 1.5 * t * t], rel=0.03, abs=1e-6)
    energy = simulation.energy()
    assert energy["work_in"] == pytest.approx(energy["kinetic"], rel=0.05)
    assert abs(energy["remainder"]) < 1e-4 * energy["kinetic"]
    # Without forces it flies on.
    before = simulation.energy()["work_in"]
    simulation.step()
    assert simulation.energy()["work_in"] == before
    with pytest.raises(drape.UsageError, match=r"give \(651, 3\), in N"):
        simulation.step(forces=[0.0, 0.0, 1.0])
    with pytest.raises(drape.UsageError, match="finite"):
        simulation.step(forces=np.full(start.shape, np.inf))


def test_a_body_is_moved_between_steps(root):
    builder = drape.SceneBuilder(spacing=0.02, time={"step": 0.002, "end": 10})
    builder.fabric("cupro", root / "fabrics/cupro-weave")
    builder.panel("cloth", "cupro", rectangle=[0.12, 0.12], turn=[-90, 0, 0])
    builder.pin("cloth", edge="top").pin("cloth", edge="bottom")
    builder.body("ball", "sphere", radius=0.03, center=[0, -0.032, 0])
    simulation = drape.Simulation(builder.scene())
    start, triangles = simulation.bodies["ball"]
    assert start.shape[1] == triangles.shape[1] == 3
    for _ in range(40):
        vertices, _ = simulation.bodies["ball"]
        simulation.move_body("ball", vertices + [0, 0.0004, 0])
        simulation.step()
    moved, _ = simulation.bodies["ball"]
    assert moved - start == pytest.approx(np.broadcast_to([0, 0.016, 0], start.shape), abs=1e-12)
    assert simulation.positions[:, 1].max() > 0.01
    energy = simulation.energy()
    assert energy["work_in"] > 0 and abs(energy["remainder"]) < 1e-3 * energy["elastic"]
    assert simulation.summary()["contact"]["crossings_found"] == 0
    simulation.move_body("ball", shift=[0, -0.01, 0], turn=[0, 90, 0], seconds=0.2)
    while simulation.time < 0.28 - 1e-9:
        simulation.step()
    assert simulation.bodies["ball"][0][:, 1] == pytest.approx(start[:, 1] + 0.006, abs=1e-12)
    with pytest.raises(drape.UsageError, match="the bodies are: ball"):
        simulation.move_body("bowl", shift=[0, 1, 0])
    with pytest.raises(drape.UsageError, match="either vertices"):
        simulation.move_body("ball")
    with pytest.raises(drape.UsageError, match=r"give \(k, 3\)"):
        simulation.move_body("ball", vertices=[0, 1, 2])
    with pytest.raises(drape.UsageError, match="give it .* s or more") as caught:
        simulation.move_body("ball", shift=[0, 0.002, 0])
    # What it advises is right.
    needed = re.search(r"top_speed = ([0-9.e-]+[0-9])", str(caught.value))[1]
    builder.set(contact={"top_speed": float(needed)})
    drape.Simulation(builder.scene()).move_body("ball", shift=[0, 0.002, 0])
    assert simulation.next_step == pytest.approx(0.002)

"""Scenes built in Python are those of a file, with the same checks."""

import subprocess

import numpy as np
import pytest
import trimesh

import drape
from test_run import frames, same_results

TIME = {"step": 0.002, "end": 0.06}


def ball():
    return trimesh.creation.icosphere(subdivisions=2, radius=0.05)


def towel_over_a_ball(fabric, folder="."):
    mesh = ball()
    builder = drape.SceneBuilder(name="built", spacing=np.float64(0.02), time=TIME, folder=folder)
    builder.fabric("cupro", fabric)
    builder.panel("towel", "cupro", rectangle=np.array([0.2, 0.3]), turn=(-90, 0, 0))
    builder.pin("towel", edge="top", motion={"times": [0, 0.05], "shift": [[0, 0, 0], [0, 0.01, 0]]})
    builder.mesh("ball", mesh.vertices, mesh.faces, center=[0, -0.052, 0], friction=0.3)
    builder.body("floor", "plane", center=[0, -0.5, 0])
    return builder.set(output={"every": 0.02})


@pytest.fixture
def cupro(root):
    return drape.fit(root / "fabrics/cupro-weave").fabric


def test_a_built_scene_gives_the_bytes_of_its_file(cupro, command, tmp_path):
    builder = towel_over_a_ball(cupro)
    builder.scene().run(tmp_path / "built")
    builder.save(tmp_path / "scene.toml")
    assert (tmp_path / "scene.toml").read_text() == builder.to_toml()
    drape.Scene.read(tmp_path / "scene.toml").run(tmp_path / "read")
    same_results(tmp_path / "built", tmp_path / "read")
    told = [command, "run", "scene.toml", "-o", "told", "--no-picture"]
    ran = subprocess.run(told, cwd=tmp_path, capture_output=True)
    assert ran.returncode == 0, ran.stderr
    same_results(tmp_path / "built", tmp_path / "told")
    with pytest.raises(drape.UsageError, match="replace=True"):
        builder.save(tmp_path / "scene.toml")
    builder.save(tmp_path / "scene.toml", replace=True)


def test_a_mesh_of_trimesh_is_its_arrays(cupro, tmp_path):
    one = towel_over_a_ball(cupro).scene()
    builder = drape.SceneBuilder(name="built", spacing=0.02, time=TIME, output={"every": 0.02})
    assert builder.fabric("cupro", cupro).mesh("ball", ball()) is builder
    builder.panel("towel", "cupro", rectangle=[0.2, 0.3], center=[0, 0.2, 0], turn=[-90, 0, 0])
    run = builder.scene().run(tmp_path / "other")
    assert run.bodies(0).shape == ball().vertices.shape and one.particles > 0
    assert np.allclose(np.sort(run.bodies(0), axis=0), np.sort(ball().vertices, axis=0))


def test_mistakes_name_the_key_and_the_value(cupro, root, tmp_path):
    builder = drape.SceneBuilder(spacing=-1, time=TIME).fabric("cupro", cupro)
    builder.panel("towel", "cupra", rectangle=[0.2, 0.3], grian=3)
    with pytest.raises(drape.InputError) as caught:
        builder.scene()
    told = {mistake.message: mistake for mistake in caught.value.mistakes}
    for word, key in [("cupra", "panel[0].fabric"), ("-1", "spacing"), ("grian", "panel[0].grian")]:
        [own] = [m for message, m in told.items() if word in message]
        assert own.key == key and own.line is None and own.remedy
    builder = drape.SceneBuilder(spacing=0.02, time=TIME).fabric("cupro", cupro)
    builder.panel("towel", "cupro", rectangle=[0.2, 0.3]).pin("towel", edge="tip")
    with pytest.raises(drape.InputError, match=r"pin\[0\].edge: .*tip"):
        builder.scene()
    elsewhere = tmp_path / "cupro.toml"
    elsewhere.write_text(cupro.to_toml())
    for allow in ([], [elsewhere]):
        keys = {"folder": root / "scenes", "allow": allow, "spacing": 0.02, "time": TIME}
        builder = drape.SceneBuilder(**keys).fabric("cupro", elsewhere)
        builder.panel("towel", "cupro", rectangle=[0.2, 0.3])
        if allow:
            # What it advises is right.
            assert builder.scene().particles == 11 * 16
        else:
            with pytest.raises(drape.InputError, match="allow="):
                builder.scene()
    with pytest.raises(drape.UsageError, match=r"panel\[1\].rectangle.*a complex"):
        builder.panel("other", "cupro", rectangle=[0.2, 1j])


def test_a_wrong_mesh_is_refused_until_it_is_mended(cupro):
    def scene(mesh):
        builder = drape.SceneBuilder(spacing=0.02, time=TIME).fabric("cupro", cupro)
        builder.panel("towel", "cupro", rectangle=[0.2, 0.3], center=[0, 0.2, 0], turn=[-90, 0, 0])
        return builder.mesh("box", mesh).scene()

    box = trimesh.creation.box([0.1, 0.1, 0.1])
    box.update_faces(np.arange(len(box.faces)) > 0)
    with pytest.raises(drape.InputError, match="collider.mesh") as caught:
        scene(box)
    assert "trimesh.repair.fill_holes" in caught.value.remedy
    # What it advises is right.
    assert trimesh.repair.fill_holes(box)
    assert scene(box).particles == 11 * 16
    builder = drape.SceneBuilder()
    with pytest.raises(drape.UsageError, match="has no faces"):
        builder.mesh("box", box.vertices)
    with pytest.raises(drape.UsageError, match=r"vertices of shape \(8, 2\); give \(k, 3\)"):
        builder.mesh("box", box.vertices[:, :2], box.faces)
    with pytest.raises(drape.UsageError, match="numbers of vertices, from 0"):
        builder.mesh("box", box.vertices, box.faces.astype(float))
    with pytest.raises(drape.InputError, match=r"collider.mesh\[0\].file"):
        wrong = drape.SceneBuilder(spacing=0.02, time=TIME).fabric("cupro", cupro)
        wrong.panel("towel", "cupro", rectangle=[0.2, 0.3]).mesh("box", box.vertices, box.faces + 1).scene()


def test_a_body_changes_its_shape_from_frame_to_frame(cupro, tmp_path):
    mesh = ball()
    moved = np.stack([mesh.vertices, mesh.vertices + [0, 0.01, 0]])

    def scene(builder):
        builder.fabric("cupro", cupro).panel(
            "towel", "cupro", rectangle=[0.2, 0.3], center=[0, 0.07, 0], turn=[-90, 0, 0]
        )
        return builder.mesh("ball", mesh, frames=moved, rate=25)

    builder = scene(drape.SceneBuilder(spacing=0.02, time=TIME))
    run = builder.scene().run(tmp_path / "own")
    assert np.ptp(run.bodies(-1) - run.bodies(0), axis=0).max() < 1e-6
    assert (run.bodies(-1) - run.bodies(0))[:, 1] == pytest.approx(0.01, abs=1e-6)
    builder.save(tmp_path / "scene.toml")
    drape.Scene.read(tmp_path / "scene.toml").run(tmp_path / "read")
    assert frames(tmp_path / "own") == frames(tmp_path / "read")
    with pytest.raises(drape.UsageError, match="give \\(f, 162, 3\\)"):
        builder.mesh("two", mesh, frames=moved[0])




def test_a_built_run_goes_on(cupro, tmp_path):
    builder = towel_over_a_ball(cupro)
    builder.scene().run(tmp_path / "own", until=0.02)
    longer = drape.resume(tmp_path / "own", extend=0.02)
    assert longer.times[-1] == pytest.approx(0.04)
    longer = drape.resume(tmp_path / "own", scene=builder.scene(), extend=0.02)
    assert longer.times[-1] == pytest.approx(0.06)


def test_names_of_files_are_told_apart(cupro):
    builder = drape.SceneBuilder(spacing=0.02, time=TIME)
    builder.fabric("a b", cupro).fabric("a/b", cupro)
    assert '"fabrics/a-b.toml"' in builder.to_toml() and '"fabrics/a-b-2.toml"' in builder.to_toml()
    builder.panel("one", "a b", rectangle=[0.1, 0.1])
    builder.panel("two", "a/b", rectangle=[0.1, 0.1], center=[0.5, 0, 0])
    assert set(builder.scene().panels) == {"one", "two"}


def two(cupro):
    builder = drape.SceneBuilder(spacing=0.02, time=TIME).fabric("cupro", cupro)
    return builder.panel("towel", "cupro", rectangle=[0.2, 0.3], center=[0, 1, 0])


@pytest.mark.parametrize("plain, moving", [("arm_0", "arm"), ("Arm_17", "arm"), ("a.b_1", "a b")])
def test_a_body_with_the_file_of_a_frame_is_refused(plain, moving, cupro, tmp_path):
    mesh = ball()
    frames = np.stack([mesh.vertices, mesh.vertices])

    def still(builder, name=plain):
        return builder.mesh(name, mesh)

    def moved(builder):
        return builder.mesh(moving, mesh, frames=frames, rate=25, center=[1, 0, 0])

    for first, second in ((still, moved), (moved, still)):
        builder = first(two(cupro))
        before = builder.to_toml()
        with pytest.raises(drape.UsageError, match="give one of them another name") as caught:
            second(builder)
        assert f"the body {plain!r}" in str(caught.value) and f"the body {moving!r}" in str(caught.value)
        assert builder.to_toml() == before
    # A letter in place of the number makes another file, and both bodies are saved.
    builder = still(moved(two(cupro)), f"{moving}_x")
    builder.save(tmp_path / "scene.toml")
    read = drape.Simulation(drape.Scene.read(tmp_path / "scene.toml")).bodies
    assert set(read) == set(drape.Simulation(builder.scene()).bodies) == {moving, f"{moving}_x"}


def test_a_file_of_the_disk_is_not_taken_for_one_that_the_builder_holds(cupro, root):
    mesh = ball()
    for there, key in (
        (lambda b: b.fabric("wool", "fabrics/cupro.toml"), "fabric.wool.file"),
        (lambda b: b.fabric("wool", "fabrics/../fabrics/Cupro.toml"), "fabric.wool.file"),
        (lambda b: b.body("other", "mesh", file="bodies/own.obj"), "collider.mesh[2].file"),
        (lambda b: b.body("other", "mesh", file="bodies/moved_3.obj"), "collider.mesh[2].file"),
        (lambda b: b.garment("patterns/skirt.toml", "cupro"), "garment[1].pattern"),
        (lambda b: b.set(fabric={"cupro": {"file": "fabrics/cupro.toml"}}), "fabric.cupro.file"),
    ):
        builder = two(cupro).mesh("own", mesh).mesh("moved", mesh, frames=[mesh.vertices], rate=1)
        builder.garment({"panel": []}, "cupro", name="skirt")
        for check in (there(builder).scene, lambda: builder.save("scene.toml")):
            with pytest.raises(drape.UsageError, match="which the builder holds") as caught:
                check()
            assert key in str(caught.value)


def test_names_are_given_once(cupro):
    with pytest.raises(drape.UsageError, match="there is a fabric 'cupro' already"):
        two(cupro).fabric("cupro", cupro)
    for twice, words in (
        (lambda b: b.panel("towel", "cupro", rectangle=[0.1, 0.1], center=[3, 0, 0]), 'two panels "towel"'),
        (lambda b: b.mesh("ball", ball()).mesh("ball", ball(), center=[3, 0, 0]), 'two bodies "ball"'),
        (lambda b: b.mesh("ball", ball()).body("ball", "plane", center=[0, -3, 0]), 'two bodies "ball"'),
    ):
        with pytest.raises(drape.InputError, match=words):
            twice(two(cupro)).scene()


def test_frames_of_a_longer_motion_are_not_read_with_a_shorter_one(cupro, tmp_path):
    mesh = ball()

    def scene(count):
        frames = [mesh.vertices + [0, 0.001 * number, 0] for number in range(count)]
        return two(cupro).mesh("ball", mesh, frames=frames, rate=50)

    scene(4).save(tmp_path / "scene.toml")
    with pytest.raises(drape.UsageError, match=r"ball_2.obj.*ball_3.obj would be read as the frames of the body 'ball'"):
        scene(2).save(tmp_path / "scene.toml", replace=True)
    scene(4).scene().run(tmp_path / "own", until=0.01)
    scene(2).scene().run(tmp_path / "own", until=0.01, replace=True)
    assert drape.resume(tmp_path / "own", extend=0.01).times[-1] == pytest.approx(0.02)


def test_the_name_of_a_body_comes_first_and_the_order_of_before_works():
    new = drape.SceneBuilder().body("ball", "sphere", radius=0.1).body("floor", "plane")
    assert new.to_toml() == drape.SceneBuilder().body("ball", kind="sphere", radius=0.1).body(
        kind="plane", name="floor"
    ).to_toml()
    with pytest.warns(FutureWarning, match=r"body\('ball', 'sphere', ...\)"):
        old = drape.SceneBuilder().body("sphere", name="ball", radius=0.1)
    old.body("floor", "plane")
    assert old.to_toml() == new.to_toml()
    with pytest.warns(FutureWarning, match=r"body\('floor', 'plane', ...\)"):
        assert "name" not in drape.SceneBuilder().body("plane", center=[0, 0, 0]).to_toml()
    # A body may be called like a kind.
    assert 'name = "box"' in drape.SceneBuilder().body("box", "box", size=[1, 1, 1]).to_toml()


@pytest.mark.parametrize("arguments", [("ball",), ("sphere", "ball"), ()])
def test_a_body_without_a_kind_is_asked_for_it(arguments):
    with pytest.raises(drape.UsageError, match=r"body\('ball', 'sphere', ...\)"):
        drape.SceneBuilder().body(*arguments)

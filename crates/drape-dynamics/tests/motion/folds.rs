//! Panels with folds, let go without gravity.

use drape_dynamics::{Simulation, Status};
use drape_input::Document;
use drape_scene::{Error, Scene};

/// Without friction a fold comes to its angle, whatever the path.
const ELASTIC: &str = r#"name = "elastic"
density = 0.2
thickness = 0.0004
shear.stiffness = 40
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.01 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.02 }
bending.rigidity = 0.8e-5
"#;

/// A strip of 60 mm × 160 mm with a fold in its middle.
struct Folded {
    /// Degrees from the warp to the height, and of the fold from the width.
    grain: f64,
    slant: f64,
    /// Degrees of the fold.
    angle: f64,
    spacing: f64,
    /// Cut as a pattern, with a rim.
    cut: bool,
}

impl Default for Folded {
    fn default() -> Self {
        Self { grain: 0.0, slant: 0.0, angle: 90.0, spacing: 10.0, cut: false }
    }
}

impl Folded {
    fn fold(&self) -> String {
        let rise = 100.0 * self.slant.to_radians().tan();
        // Off the nodes, and out to both sides.
        let (from, to) = (83.0 - 0.7 * rise, 83.0 + 0.3 * rise);
        format!("from = [-40, {from}]\nto = [60, {to}]\nangle = {}\n", self.angle)
    }

    fn scene(&self) -> Result<Scene, Error> {
        let Self { grain, spacing, .. } = self;
        let fold = self.fold();
        let (panel, pattern) = if self.cut {
            (
                "[[garment]]\npattern = \"strip.toml\"\nfabric = \"cloth\"\n".to_owned(),
                format!(
                    "length = \"mm\"\n[panel.strip]\ngrain = {grain}\nrectangle = [60, 160]\n\
                     origin = [0, 0, 0]\n[[panel.strip.fold]]\n{fold}"
                ),
            )
        } else {
            (
                format!(
                    "[[panel]]\nname = \"strip\"\nfabric = \"cloth\"\nrectangle = [60, 160]\n\
                     grain = {grain}\ncenter = [30, 80, 0]\n[[panel.fold]]\n{fold}"
                ),
                String::new(),
            )
        };
        let hold = "[[pin]]\npanel = \"strip\"\npoints = [[30, 0]]\nradius = 15\n";
        let text = format!(
            "length = \"mm\"\nspacing = {spacing}\ngravity = [0, 0, 0]\n\
             fabric.cloth.file = \"cloth.toml\"\n{panel}\n{hold}[time]\nstep = 0.005\nend = 1000\n\
             [settle]\nresidual = 3e-6\n"
        );
        let documents =
            [Document::new("cloth.toml", ELASTIC), Document::new("strip.toml", pattern)];
        Scene::from_documents(&Document::new("scene.toml", text), &documents)
    }

    /// The angle between the two flat parts, in degrees, towards the right side; how far a facet
    /// there leans from its part at most, likewise; and the angle of the fold's line from the
    /// width.
    fn come_to_rest(&self) -> [f64; 3] {
        let mut simulation = Simulation::new(self.scene().unwrap()).unwrap();
        let summary = simulation.run(&mut ()).unwrap();
        assert_eq!(summary.status, Status::Ok, "{summary:?}");
        let positions = simulation.positions().to_vec();
        let at = |k: u32| -> [f64; 3] { std::array::from_fn(|a| positions[3 * k as usize + a]) };
        let (sin, cos) = self.slant.to_radians().sin_cos();
        let (grain_sin, grain_cos) = self.grain.to_radians().sin_cos();
        let mut parts = [[0.0; 3]; 2];
        let mut facets = Vec::new();
        for triangle in simulation.triangles() {
            let middle = triangle.iter().fold([0.0; 2], |sum, &k| {
                let [u, v] = simulation.coordinates()[k as usize];
                let place = [grain_cos * u - grain_sin * v, grain_sin * u + grain_cos * v];
                [sum[0] + place[0] / 3.0, sum[1] + place[1] / 3.0]
            });
            let height = middle[1] - 0.083;
            let beside = cos * height - sin * (middle[0] - 0.030);
            if beside.abs() < 0.002 * self.spacing {
                continue;
            }
            let [a, b, c] = triangle.map(at);
            let [u, v] = [b, c].map(|end| [0, 1, 2].map(|k| end[k] - a[k]));
            let normal = cross(u, v);
            let part = usize::from(beside > 0.0);
            (0..3).for_each(|k| parts[part][k] += normal[k]);
            facets.push((part, unit(normal)));
        }
        let parts = parts.map(unit);
        let lean = facets.iter().map(|(part, normal)| between(parts[*part], *normal));
        let lean = lean.fold(0.0, f64::max).to_degrees();
        let line = cross(parts[0], parts[1]);
        // The lower part is held in its plane, where x is the width.
        let direction = line[1].atan2(line[0]).to_degrees();
        let sign = if direction.abs() < 90.0 { 1.0 } else { -1.0 };
        let direction = if sign > 0.0 { direction } else { direction - 180.0 * direction.signum() };
        [sign * between(parts[0], parts[1]).to_degrees(), lean, direction]
    }
}

fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

fn between(u: [f64; 3], v: [f64; 3]) -> f64 {
    let across = cross(u, v).iter().map(|x| x * x).sum::<f64>().sqrt();
    across.atan2(u.iter().zip(v).map(|(a, b)| a * b).sum())
}

#[test]
fn a_strip_comes_to_the_angle_of_its_fold() {
    for (spacing, angle) in [(10.0, 90.0), (5.0, 90.0), (10.0, -40.0), (10.0, 130.0)] {
        let [found, lean, direction] =
            Folded { spacing, angle, ..Folded::default() }.come_to_rest();
        println!("{spacing} mm, {angle}°: {found:.2}°, leans {lean:.2}°, runs at {direction:.2}°");
        assert!((found / angle - 1.0).abs() < 0.01, "{found} for {angle} at {spacing} mm");
        assert!(lean < 1.0 && direction.abs() < 0.1, "{lean} {direction}");
    }
}

#[test]
fn a_fold_may_run_at_any_angle_to_the_yarns() {
    let cases = [(0.0, 45.0, 10.0), (0.0, 10.0, 10.0), (0.0, 30.0, 5.0), (45.0, 0.0, 10.0)];
    for (grain, slant, spacing) in cases {
        let folded = Folded { grain, slant, spacing, ..Folded::default() };
        let [found, lean, direction] = folded.come_to_rest();
        println!(
            "{grain}°, slant {slant}°, {spacing} mm: {found:.2}°, {lean:.2}°, {direction:.2}°"
        );
        assert!((found / 90.0 - 1.0).abs() < 0.02, "{found} at {grain}°, {slant}°, {spacing} mm");
        assert!((direction - slant).abs() < 1.5, "{direction} for {slant}");
    }
}

#[test]
fn a_fold_crosses_the_rim_of_a_cut_panel() {
    for (grain, slant, spacing) in [(0.0, 0.0, 10.0), (30.0, 0.0, 5.0), (20.0, 30.0, 10.0)] {
        let folded = Folded { grain, slant, spacing, cut: true, ..Folded::default() };
        let [found, lean, direction] = folded.come_to_rest();
        println!("cut {grain}°, {slant}°, {spacing} mm: {found:.2}°, {lean:.2}°, {direction:.2}°");
        assert!((found / 90.0 - 1.0).abs() < 0.04, "{found} at {grain}°, {slant}°, {spacing} mm");
        assert!((direction - slant).abs() < 2.0, "{direction} for {slant}");
    }
}

#[test]
fn folds_that_are_none_are_refused() {
    let refused = |folded: Folded, word: &str| {
        let error = folded.scene().map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    };
    refused(Folded { angle: 150.0, ..Folded::default() }, "beyond 140");
    refused(Folded { angle: 150.0, cut: true, ..Folded::default() }, "150 is not between -140");
}

#[test]
fn a_seam_has_the_angle_of_its_pattern() {
    let pattern = "length = \"mm\"\n[panel.a]\nrectangle = [60, 60]\norigin = [0, 0, 0]\n\
                   [panel.b]\nrectangle = [60, 60]\norigin = [70, 0, 0]\n\
                   [seam.middle]\nsides = [[\"a.right\"], [\"b.left\"]]\nangle = 40\n";
    let text = "length = \"mm\"\nspacing = 10\ngravity = [0, 0, 0]\n\
                fabric.cloth.file = \"cloth.toml\"\n\
                [[garment]]\npattern = \"two.toml\"\nfabric = \"cloth\"\n\
                [[pin]]\npanel = \"a\"\nedge = \"left\"\n\
                [[pin]]\npanel = \"a\"\npoints = [[20, 30]]\n\
                [time]\nstep = 0.005\nend = 1000\n[settle]\nresidual = 3e-6\n";
    let documents = [Document::new("cloth.toml", ELASTIC), Document::new("two.toml", pattern)];
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &documents).unwrap();
    let mut simulation = Simulation::new(scene).unwrap();
    let summary = simulation.run(&mut ()).unwrap();
    assert_eq!(summary.status, Status::Ok, "{summary:?}");
    let positions = simulation.positions().to_vec();
    let half = (positions.len() / 6) as u32;
    let mut panels = [[0.0; 3]; 2];
    for triangle in simulation.triangles() {
        let at = |k: u32| -> [f64; 3] { std::array::from_fn(|a| positions[3 * k as usize + a]) };
        let [a, b, c] = triangle.map(at);
        let [u, v] = [b, c].map(|end| [0, 1, 2].map(|k| end[k] - a[k]));
        let normal = cross(u, v);
        (0..3).for_each(|k| panels[usize::from(triangle[0] >= half)][k] += normal[k]);
    }
    let [inner, outer] = panels.map(unit);
    let angle = between(inner, outer).to_degrees();
    println!("{angle:.2}° for 40°");
    // The second panel rises towards the right side, and its normal leans back.
    assert!((angle - 40.0).abs() < 1.0 && outer[0] < inner[0], "{angle}");
}

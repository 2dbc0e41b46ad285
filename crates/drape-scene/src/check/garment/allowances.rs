//! Allowances of seams and hems: more cloth along lines of a panel.

use drape_cloth::Allowance;
use drape_pattern::{CutPattern, NodeId, Pattern};

/// Line of nodes of a cut panel along which more of its cloth lies.
pub(crate) struct AllowanceLine {
    /// Nodes of the cut.
    nodes: Vec<u32>,
    /// Width, in m.
    width: f64,
}

impl AllowanceLine {
    /// Line with other numbers of its nodes.
    pub(crate) fn numbered(&self, numbers: &[u32]) -> Allowance {
        Allowance {
            line: self.nodes.iter().map(|&node| numbers[node as usize]).collect(),
            width: self.width,
        }
    }
}

/// Returns for each panel of a cut pattern the allowances of the seams that are sewn to the panel,
/// and of its hems.
pub(crate) fn allowances(pattern: &Pattern, cut: &CutPattern) -> Vec<Vec<AllowanceLine>> {
    let mut lines: Vec<Vec<AllowanceLine>> = Vec::new();
    lines.resize_with(cut.panels.len(), Vec::new);
    for (seam, nodes) in pattern.seams().iter().zip(&cut.seams) {
        for side in 0..2 {
            let nodes: Vec<NodeId> = nodes.side(side).collect();
            // A side goes on from one panel to another.
            for run in nodes.chunk_by(|one, next| one.panel == next.panel) {
                let nodes = run.iter().map(|id| id.node).collect();
                lines[run[0].panel].push(AllowanceLine { nodes, width: seam.allowance });
            }
        }
    }
    for ((panel, cut), lines) in pattern.panels().iter().zip(&cut.panels).zip(&mut lines) {
        let hems = panel.edges().zip(&cut.edges);
        lines.extend(
            hems.map(|(edge, nodes)| AllowanceLine { nodes: nodes.clone(), width: edge.hem }),
        );
    }
    lines
}

#[cfg(test)]
mod tests {
    use drape_input::Document;

    use crate::scene::Scene;

    /// A panel on the bias with a hem and a dart between the two parts of its upper edge, to which
    /// two others are sewn.
    const PATTERN: &str = r#"length = "mm"
[panel.skirt]
grain = 20
start = [0, 0]
outline = [
    { name = "hem", to = [120, 0], hem = 25 },
    { name = "right", to = [120, 100] },
    { name = "top_right", to = [70, 100] },
    { name = "leg_right", to = [60, 60] },
    { name = "leg_left", to = [50, 100] },
    { name = "top_left", to = [0, 100] },
    { name = "left", to = [0, 0] },
]
origin = [0, 0, 0]
[panel.band_left]
rectangle = [60, 60]
origin = [-10, 115, 0]
[panel.band_right]
rectangle = [40, 60]
origin = [80, 115, 0]
[seam.dart]
sides = [["skirt.leg_right"], ["skirt.leg_left"]]
allowance = 5
[seam.waist]
sides = [["skirt.top_right", "skirt.top_left"], ["band_right.bottom", "band_left.bottom"]]
allowance = 10
"#;

    fn scene(pattern: &str) -> Scene {
        let fabric = |density: f64| {
            let yarn = "traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, \
                        toe_strain_after = 0.01 }\nbending.rigidity = 1e-5\n";
            format!(
                "name = \"plain\"\ndensity = {density}\nthickness = 0.0003\nshear.stiffness = 40\n\
                 [warp]\n{yarn}[weft]\n{yarn}"
            )
        };
        let documents = [
            Document::new("heavy.toml", fabric(0.2)),
            Document::new("light.toml", fabric(0.1)),
            Document::new("pattern.toml", pattern),
        ];
        let text = "length = \"mm\"\nspacing = 10\nfabric.heavy.file = \"heavy.toml\"\n\
                    fabric.light.file = \"light.toml\"\n[[garment]]\npattern = \"pattern.toml\"\n\
                    fabric = \"heavy\"\npanel.band_left.fabric = \"light\"\n\
                    [time]\nstep = 0.005\nend = 1\n";
        Scene::from_documents(&Document::new("scene.toml", text), &documents).expect("it is right")
    }

    #[test]
    fn allowances_and_hems_weigh_what_their_cloth_weighs() {
        let scene = scene(PATTERN);
        let leg = 10_f64.hypot(40.0);
        let dart = 2.0 * 5.0 * leg;
        let skirt = 120.0 * 100.0 - 0.5 * 20.0 * 40.0 + 25.0 * 120.0 + dart + 10.0 * 100.0;
        let [left, right] = [60.0, 40.0].map(|width| width * 60.0 + 10.0 * width);
        let exact = 1e-6 * (0.2 * (skirt + right) + 0.1 * left);
        let mass: f64 = scene.cloth.masses().iter().sum();
        assert!((mass / exact - 1.0).abs() < 1e-12, "{mass} kg and {exact} kg");
    }

    #[test]
    fn no_particle_loses_mass_and_none_off_the_seams_gains_any() {
        let mut plain = PATTERN.to_owned();
        for line in [", hem = 25", "allowance = 5\n", "allowance = 10\n"] {
            assert!(plain.contains(line));
            plain = plain.replace(line, "");
        }
        let (before, after) = (scene(&plain), scene(PATTERN));
        assert_eq!(before.start.positions, after.start.positions);
        assert_eq!(before.cloth.areas(), after.cloth.areas());
        let mut gains = vec![false; after.start.positions.len() / 3];
        let sewing = after.sewing.as_ref().expect("it has seams");
        sewing.seams.iter().flat_map(|seam| seam.pairs.pairs.as_flattened()).for_each(|&node| {
            gains[node as usize] = true;
        });
        for panel in &after.panels {
            let hem = panel.edges.iter().find(|edge| edge.name == "hem");
            let nodes = hem.iter().flat_map(|edge| &edge.nodes);
            nodes.for_each(|&node| gains[panel.first + node as usize] = true);
        }
        let masses = before.cloth.masses().iter().zip(after.cloth.masses());
        for (particle, (before, after)) in masses.enumerate() {
            assert_eq!(after > before, gains[particle], "{particle}: {before} kg, {after} kg");
            assert!(after >= before, "{particle}: {before} kg, {after} kg");
        }
    }
}

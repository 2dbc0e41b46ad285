use drape_pattern::{Panel, Pattern};

use crate::garments::{cut, shipped};

#[test]
fn darts_are_open_notches_whose_legs_are_sewn_to_one_tip() {
    let pattern = shipped("pencil-skirt.toml");
    for spacing in [0.005, 0.01, 0.02] {
        let (_, cut) = cut(&pattern, spacing);
        for (stitch, seam) in pattern.stitches().iter().zip(&cut.seams) {
            if !stitch.name.contains("dart") {
                continue;
            }
            let [mouth, tip] = [seam[0], seam[seam.len() - 1]];
            let panel = &cut.panels[tip[0].panel];
            let place = |node: u32| panel.positions[node as usize];
            assert_eq!(tip[0], tip[1], "{}: both legs end in one node", stitch.name);
            assert!(panel.hard[tip[0].node as usize]);
            let depth = if panel.panel == "front" { 0.48 } else { 0.44 };
            assert!((place(tip[0].node)[1] - depth).abs() < 1e-12, "{}", stitch.name);
            let width = place(mouth[0].node)[0] - place(mouth[1].node)[0];
            let expected = if panel.panel == "front" { 0.025 } else { 0.035 };
            assert!((width - expected).abs() < 1e-12, "{}: {width} m open", stitch.name);
        }
    }
}

#[test]
fn darts_are_cut_as_well_on_the_bias() {
    let pattern = shipped("pencil-skirt.toml");
    let turned = |panel: &Panel| {
        panel.clone().with_grain(std::f64::consts::FRAC_PI_4).expect("it is finite")
    };
    let panels = pattern.panels().iter().map(turned).collect();
    let bias = Pattern::new(panels, pattern.stitches().to_vec()).expect("it is sound");
    for spacing in [0.005, 0.01, 0.02] {
        cut(&bias, spacing);
    }
}

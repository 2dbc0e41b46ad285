//! Darts of a shipped skirt.

use drape_pattern::{Panel, Pattern};

use crate::garments::{cut, shipped};

#[test]
fn darts_are_open_notches_whose_legs_are_sewn_to_one_tip() {
    let pattern = shipped("pencil-skirt.toml");
    for spacing in [0.005, 0.01, 0.02] {
        let (_, cut) = cut(&pattern, spacing);
        for (seam, nodes) in pattern.seams().iter().zip(&cut.seams) {
            if !seam.name.contains("dart") {
                continue;
            }
            let [mouth, tip] = [nodes.pairs[0], nodes.pairs[nodes.pairs.len() - 1]];
            let panel = &cut.panels[tip[0].panel];
            let place = |node: u32| panel.positions[node as usize];
            assert_eq!(tip[0], tip[1], "{}: both legs end in one node", seam.name);
            assert!(panel.hard[tip[0].node as usize]);
            let depth = if panel.panel == "front" { 0.48 } else { 0.44 };
            assert!((place(tip[0].node)[1] - depth).abs() < 1e-12, "{}", seam.name);
            let width = place(mouth[0].node)[0] - place(mouth[1].node)[0];
            let expected = if panel.panel == "front" { 0.025 } else { 0.035 };
            assert!((width - expected).abs() < 1e-12, "{}: {width} m open", seam.name);
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
    let bias = Pattern::new(panels, pattern.seams().to_vec()).expect("it is sound");
    for spacing in [0.005, 0.01, 0.02] {
        cut(&bias, spacing);
    }
}

#[test]
fn a_waistband_is_sewn_over_the_mouths_of_darts_and_over_the_side_seam() {
    let pattern = shipped("pencil-skirt.toml");
    let (_, cut) = cut(&pattern, 0.01);
    let number = |name: &str| pattern.panels().iter().position(|p| p.name() == name).expect(name);
    let [back, band, front] = ["back", "band", "front"].map(number);
    let number = pattern.seams().iter().position(|s| s.name == "band").expect("it is there");
    let seam = &cut.seams[number];
    // Where the chain leaves a piece of the waist, one node of the band has two partners: at the
    // mouths of four darts and at one side seam.
    let twice: Vec<_> = seam.pairs.windows(2).filter(|two| two[0][0] == two[1][0]).collect();
    assert_eq!(twice.len(), 5);
    let sewn: Vec<u32> = twice.iter().map(|two| two[0][0].node).collect();
    assert!(sewn.iter().all(|&node| cut.panels[band].hard[node as usize]), "{sewn:?}");
    let panels: Vec<[usize; 2]> =
        twice.iter().map(|two| [two[0][1].panel, two[1][1].panel]).collect();
    assert_eq!(panels, [[front; 2], [front; 2], [front, back], [back; 2], [back; 2]]);
    // Both mouth nodes are the ends of the legs of one dart.
    let place = |id: drape_pattern::NodeId| cut.panels[id.panel].positions[id.node as usize];
    assert_eq!(twice[0].iter().map(|pair| place(pair[1])[0]).collect::<Vec<_>>(), [0.1075, 0.1325]);
    let band = &cut.panels[band];
    assert_eq!(
        band.edges[0].len() - 1,
        seam.pairs.len() - 1 - twice.len(),
        "all of its nodes are sewn"
    );
}

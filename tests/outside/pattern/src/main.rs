//! Areas of the panels and lengths of the seams of a skirt, whose drawing is a string. The skirt
//! goes to DXF, and comes back from it.

use std::f64::consts::PI;
use std::time::Instant;

use drape_input::Document;
use drape_pattern::{EdgeId, Error, Pattern, Seam};

/// Drawing in mm of a front with a round waist and of a back with a straight one.
const DRAWING: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="1000mm" height="700mm" viewBox="0 0 1000 700">
  <path id="front" d="M 50 650 L 450 650 L 400 50 A 150 150 0 0 1 100 50 Z"/>
  <g transform="translate(500 0)">
    <path id="back" d="M 50 650 L 450 650 L 400 50 L 100 50 Z"/>
  </g>
</svg>"#;

/// Returns the slanting edge of `panel`, a number of a panel of `pattern`: its right edge if
/// `is_right`, or else its left edge. `None` if the panel has no such edge.
fn side(pattern: &Pattern, panel: usize, is_right: bool) -> Option<EdgeId> {
    let outline = pattern.panels()[panel].outline();
    let slanting = outline.iter().position(|edge| {
        let [across, along] = [0, 1].map(|k| edge.end[k] - edge.start[k]);
        across.abs() > 0.01 && along.abs() > 0.1 && (along > 0.0) == is_right
    });
    slanting.map(|edge| EdgeId { panel, edge })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let begin = Instant::now();
    let drawn = Pattern::parse(&Document::new("skirt.svg", DRAWING))?;

    // A drawing has no seams. The right side of the front is sewn to the left side of the back.
    let mut seams = Vec::new();
    for (name, is_right) in [("right", true), ("left", false)] {
        let edges = [side(&drawn, 0, is_right), side(&drawn, 1, !is_right)];
        let [Some(front), Some(back)] = edges else { return Err("no side".into()) };
        seams.push(Seam {
            name: name.into(),
            sides: [vec![front], vec![back]],
            reversed: false,
            max_ease: 1.1,
            angle: 0.0,
            allowance: 0.01,
        });
    }
    let pattern = Pattern::new(drawn.panels().to_vec(), seams).map_err(Error::Pattern)?;
    let area = |panel: usize| pattern.panels()[panel].area();
    let length = |side: &[EdgeId]| -> f64 {
        let edges = side.iter().map(|id| &pattern.panels()[id.panel].outline()[id.edge]);
        edges.map(|edge| edge.length()).sum()
    };
    let lengths = pattern.seams().iter().map(|seam| seam.sides.each_ref().map(|s| length(s)));
    let lengths: Vec<[f64; 2]> = lengths.collect();
    let dxf = pattern.to_dxf("skirt");
    let again = Pattern::parse(&Document::new("skirt.dxf", dxf.text))?;
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();

    // A trapezium, less half a disc at the waist of the front.
    let trapezium = 0.5 * (0.4 + 0.3) * 0.6;
    for (measured, exact) in [(area(0), trapezium - 0.5 * PI * 0.15 * 0.15), (area(1), trapezium)] {
        assert!((measured / exact - 1.0).abs() < 1e-9, "{measured} m², not {exact} m²");
    }
    for length in lengths.iter().flatten() {
        assert!((length / 0.6_f64.hypot(0.05) - 1.0).abs() < 1e-9, "{length} m");
    }
    // DXF has chords within 0.1 mm of a curve, and no words for seams.
    for (panel, again) in pattern.panels().iter().zip(again.panels()) {
        assert_eq!(panel.name(), again.name());
        assert!((again.area() / panel.area() - 1.0).abs() < 2e-4, "{}", panel.name());
    }
    assert!(dxf.notes.iter().any(|note| note.to_string().contains("2 seams")), "{:?}", dxf.notes);
    println!(
        "front {:.4} m², back {:.4} m², seams of {:.4} and {:.4} m: {milliseconds:.2} ms",
        area(0),
        area(1),
        lengths[0][0],
        lengths[1][0]
    );
    Ok(())
}

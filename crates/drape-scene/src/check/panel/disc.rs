//! Discs with a round rim: cut as a panel of a pattern is, with triangles between cells and circle.

use std::f64::consts::PI;

use drape_cloth::{Grain, Lattice};
use drape_pattern::{Curve, Cutter, Edge, Panel, Pattern};

use crate::check::panel::cut_lattice::{cut_lattice, node_numbers};

/// Returns a disc of a radius, in m, with particles on its circle; `None` for sizes that panels of
/// patterns do not have.
pub(super) fn disc(radius: f64, spacing: f64) -> Option<Lattice> {
    if !(radius >= spacing) {
        return None;
    }
    let half =
        |name: &str, x: f64| Edge::line(name, [x, 0.0], [-x, 0.0]).curved(Curve::Arc { sweep: PI });
    let panel = Panel::new("disc", vec![half("upper", radius), half("lower", -radius)]).ok()?;
    let pattern = Pattern::new(vec![panel], Vec::new()).ok()?;
    let cut = &Cutter::new(spacing).cut(&pattern).ok()?.panels[0];
    let disc = cut_lattice(cut, &node_numbers(cut), Grain::default()).ok()?;
    Some(disc.with_middle([0.0; 2]))
}

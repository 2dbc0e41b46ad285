//! Discs with a round rim: cut as a panel of a pattern is, with triangles between cells and circle.

use std::f64::consts::PI;

use drape_cloth::{Error, Grain, Lattice};
use drape_pattern::{Curve, Cutter, Edge, Panel, Pattern};

use crate::check::panel::cut_lattice::{cut_lattice, node_numbers};

/// Returns a disc of a radius, in m, with particles on its circle.
///
/// # Errors
/// When a length is not positive, fewer than 3 particles would lie across the disc, or too many.
pub(super) fn disc(radius: f64, spacing: f64) -> Result<Lattice, Error> {
    if !(radius >= spacing) {
        return Err(Error::Spacing { spacing, size: 2.0 * radius });
    }
    let half =
        |name: &str, x: f64| Edge::line(name, [x, 0.0], [-x, 0.0]).curved(Curve::Arc { sweep: PI });
    let panel = Panel::new("disc", vec![half("upper", radius), half("lower", -radius)]).ok();
    let pattern = panel.and_then(|panel| Pattern::new(vec![panel], Vec::new()).ok());
    let cut = pattern.and_then(|pattern| Cutter::new(spacing).cut(&pattern).ok());
    // A circle is a sound outline: what is left to go wrong is its size.
    let Some(cut) = cut else { return Err(Error::Spacing { spacing, size: 2.0 * radius }) };
    let cut = &cut.panels[0];
    let mut disc = cut_lattice(cut, &node_numbers(cut), Grain::default())?;
    disc.middle = [0.0; 2];
    Ok(disc)
}

//! Closest place: where surfaces are closest to their minimum separation, for a message.

use std::fmt;

use drape_collide::{PairDistance, PinchPolicy, SurfaceContact};

/// Place where surfaces are closest to their minimum separation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClosestPlace {
    /// Names of the panel or body on each side.
    names: [String; 2],
    /// Position of a vertex there, in m.
    position: [f64; 3],
    /// Distance, in m.
    distance: f64,
    /// Distance that the two keep, in m.
    min_separation: f64,
    /// Bodies that are near the same cloth, if there are two.
    pub(crate) closing: Option<ClosingBodies>,
}

/// Two bodies with cloth between them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClosingBodies {
    /// Names of the bodies.
    pub(crate) names: [String; 2],
    /// Treatment of cloth that bodies close on.
    pub(crate) policy: PinchPolicy,
}

impl ClosestPlace {
    /// Finds the place among the pairs of the last detection of `contact`. `names` has the panels
    /// and then the bodies, one for each group of the surface, and `positions` the particles, in m.
    pub(crate) fn find(
        contact: &SurfaceContact,
        names: &[String],
        positions: &[f64],
    ) -> Option<Self> {
        let PairDistance { pair, distance } = contact.pairs().closest()?;
        let surface = contact.surface();
        let name_of = |vertex: u32| names.get(surface.group(vertex).ok()? as usize).cloned();
        let start = 3 * pair.vertices.into_iter().min()? as usize;
        let position = positions.get(start..start + 3)?.try_into().ok()?;

        // The vertices of the cloth come before the vertices of bodies.
        let is_body = |vertex: u32| vertex as usize >= surface.free_count();
        let cloth: Vec<u32> =
            pair.vertices.into_iter().filter(|vertex| !is_body(*vertex)).collect();
        let first_body = pair.vertices.into_iter().find(|vertex| is_body(*vertex));
        let closing = first_body.and_then(|first| {
            let near = contact
                .pairs()
                .iter()
                .filter(|near| near.pair.vertices.iter().any(|vertex| cloth.contains(vertex)));
            let mut bodies = near
                .filter_map(|near| near.pair.vertices.into_iter().find(|vertex| is_body(*vertex)));
            let group = surface.group(first).ok()?;
            let second =
                bodies.find(|body| surface.group(*body).is_ok_and(|other| other != group))?;
            let policy = contact.state().pinch_policy();
            Some(ClosingBodies { names: [name_of(first)?, name_of(second)?], policy })
        });

        let names = [name_of(pair.vertices[0])?, name_of(pair.vertices[3])?];
        Some(Self { names, position, distance, min_separation: pair.min_separation, closing })
    }
}

impl fmt::Display for ClosestPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = &self.names;
        let [x, y, z] = self.position;
        write!(
            f,
            "surfaces are nearest to what they keep between \"{first}\" and \"{second}\" near \
             ({x:.4}, {y:.4}, {z:.4}) m, {:.4} of {:.4} mm",
            1e3 * self.distance,
            1e3 * self.min_separation
        )
    }
}

impl ClosingBodies {
    /// Returns what helps, in words.
    pub(crate) fn remedy(&self) -> String {
        let [first, second] = &self.names;
        match self.policy {
            PinchPolicy::Error => format!(
                "\"{first}\" and \"{second}\" close on the cloth there: write contact.pinch = \"thin\", with which \
                 the cloth keeps a tenth of that distance from them, or leave more room between them"
            ),
            PinchPolicy::Thin | PinchPolicy::Release => format!(
                "\"{first}\" and \"{second}\" close on the cloth there: leave more room between them"
            ),
        }
    }
}

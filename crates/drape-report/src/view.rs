use crate::camera::Camera;
use crate::error::ReportError;
use crate::scene::{Scene, check_range};

/// From where a scene is seen, and how large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Direction of the eye around the vertical: 0° from +z, 90° from +x.
    pub azimuth_deg: f64,
    /// Height of the eye over the horizon, from -90° to 90°.
    pub elevation_deg: f64,
    /// Vertical field of view, in degrees; a small one is a long lens.
    pub field_deg: f64,
    /// Width of the picture, in pixels.
    pub width: u32,
    /// Height of the picture, in pixels.
    pub height: u32,
    /// How far bodies step back behind the cloth that covers them, in m.
    ///
    /// The chord between two particles on either side of a convex edge dips below the edge. With
    /// a setback of that depth the edge does not show through the cloth.
    pub body_setback: f64,
}

impl Default for View {
    /// From the front right and above, 1200 × 900 pixels.
    fn default() -> View {
        View {
            azimuth_deg: 30.0,
            elevation_deg: 28.0,
            field_deg: 24.0,
            width: 1200,
            height: 900,
            body_setback: 0.0,
        }
    }
}

impl View {
    /// The camera that shows the whole of a scene.
    pub fn camera(&self, scene: &Scene) -> Result<Camera, ReportError> {
        self.check()?;
        scene.check()?;
        Ok(Camera::framing(self, scene))
    }

    pub(crate) fn check(&self) -> Result<(), ReportError> {
        let within = |what, value: f64, range, least, most| {
            check_range(what, value, range, (least..=most).contains(&value))
        };
        let size = "from 16 to 16384";
        within("the azimuth (°)", self.azimuth_deg, "finite", -1e6, 1e6)?;
        within("the elevation (°)", self.elevation_deg, "from -90 to 90", -90.0, 90.0)?;
        within("the field of view (°)", self.field_deg, "from 1 to 120", 1.0, 120.0)?;
        within("the width (pixels)", self.width.into(), size, 16.0, 16384.0)?;
        within("the height (pixels)", self.height.into(), size, 16.0, 16384.0)?;
        within("the setback of bodies (m)", self.body_setback, "from 0 to 1", 0.0, 1.0)
    }
}

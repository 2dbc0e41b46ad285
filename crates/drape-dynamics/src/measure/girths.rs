//! Girths and ease of garments at bust, waist and hip of the body in its final pose.

use drape_collide::Shape;
use drape_scene::{ClothPlaces, Figures, GirthPair, MeasuredGarment};
use serde_json::{Map, Value, json};

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Returns the girths of the garments of `world`, by the names of the garments and of the
/// landmarks.
pub(crate) fn measures(parts: &GarmentParts, world: &World) -> Value {
    let bodies = world.contact.bodies().iter().zip(world.contact.triangulations());
    let solid = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane));
    let figures = Figures::new(solid.map(|(_, outline)| outline).collect());
    let cloth =
        ClothPlaces { coordinates: world.cloth.coordinates(), positions: &world.state.positions };

    let mut garments = Map::new();
    for garment in &parts.measured {
        let girths = garment.girths(cloth, &figures);
        if !girths.is_empty() {
            let rows = girths.iter().map(|pair| (pair.landmark.name.clone(), row(pair)));
            garments.insert(key(&garments, garment), Value::Object(rows.collect()));
        }
    }
    Value::Object(garments)
}

/// Returns the name of `garment`, with a number if the name is a key of `taken`.
fn key(taken: &Map<String, Value>, garment: &MeasuredGarment) -> String {
    let name = &garment.name;
    let numbered = (2..).map(|number| format!("{name} {number}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    names.find(|name| !taken.contains_key(name)).unwrap_or_default()
}

/// Returns the measures of `pair`, in m. If the garment has no girth there, the row has a reason
/// and no ease.
fn row(pair: &GirthPair) -> Value {
    let GirthPair { landmark, body, garment } = pair;
    let found_by = landmark.found_by.word();

    match garment {
        Ok(girth) => json!({
            "height": landmark.height,
            "found_by": found_by,
            "garment_height": girth.height,
            "body": body,
            "garment": girth.worn,
            "hull": girth.hull,
            "pattern": girth.pattern,
            "ease": girth.worn - body,
            "pattern_ease": girth.pattern - body,
        }),
        Err(missing) => json!({
            "height": landmark.height,
            "found_by": found_by,
            "body": body,
            "not_measured": missing.reason(),
        }),
    }
}

//! Girths and ease of garments at bust, waist and hip of the body in its pose at the end.

use drape_collide::Shape;
use drape_scene::{ClothPlaces, Figures, GirthPair, MeasuredGarment};
use serde_json::{Map, Value, json};

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Girths of the garments of a world, by their names and by places.
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

/// Returns the name of a garment, with a number if another one has it.
fn key(taken: &Map<String, Value>, garment: &MeasuredGarment) -> String {
    let name = &garment.name;
    let numbered = (2..).map(|number| format!("{name} {number}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    names.find(|name| !taken.contains_key(name)).unwrap_or_default()
}

/// Measures at a place, in m. Without a girth of the garment there is a reason, and no ease.
fn row(pair: &GirthPair) -> Value {
    let GirthPair { landmark, body, garment } = pair;
    let found = landmark.found_by.word();
    match garment {
        Ok(own) => json!({
            "height": landmark.height,
            "found_by": found,
            "garment_height": own.height,
            "body": body,
            "garment": own.worn,
            "hull": own.hull,
            "pattern": own.pattern,
            "ease": own.worn - body,
            "pattern_ease": own.pattern - body,
        }),
        Err(none) => json!({
            "height": landmark.height,
            "found_by": found,
            "body": body,
            "not_measured": none.reason(),
        }),
    }
}

use drape_fabric::{BendingLaw, Law, Memory};

use super::block::{Block, one, outer, sum};
use crate::angle::{Angle, bow_of};
use crate::field::{Vector, add, dot, scale, subtract};

/// Derivatives of the energy with respect to a bow at a normal, and the energy; `spacing` is the length of a
/// yarn's segments.
pub(crate) fn bend(
    (law, memory): (&BendingLaw, &Memory),
    (bow, normal): (Vector, Vector),
    spacing: f64,
    definite: bool,
) -> (Vector, Block, f64) {
    let rest = bow_of(law.rest_curvature, spacing);
    let excess = subtract(bow, scale(normal, rest));
    let length = dot(excess, excess).sqrt();
    let angle = Angle::of(length * length, spacing);
    let size = angle.curvature(length);
    let elastic = law.backbone.respond(size);
    let (first, second) = angle.derivatives(length);
    let (load, tangent) =
        (elastic.load * first, elastic.tangent * first * first + elastic.load * second);
    let along = dot(bow, normal);
    let slip = curvature(bow, normal, spacing) - memory.position;
    let friction = law.friction.respond(memory.friction, slip);
    let (first, second) = Angle::of(along * along, spacing).derivatives(along);
    let slope = friction.tangent * first * first + friction.load * second;
    let friction = friction.load * first;
    let slope = if definite { slope.max(0.0) } else { slope };
    let (secant, unit) =
        if length > 0.0 { (load / length, scale(excess, 1.0 / length)) } else { (tangent, excess) };
    let moment = add(scale(excess, secant), scale(normal, friction));
    let block = sum([
        (slope, outer(normal, normal)),
        (secant, one()),
        (tangent - secant, outer(unit, unit)),
    ]);
    let energy = law.backbone.energy(size) + law.friction.work(memory.friction, slip);
    (moment, block, energy)
}

/// The same at a fold, which adds to the rest curvature, in 1/m: the curvature is counted about the normal, and what the yarn
/// bows within the surface apart from it.
pub(crate) fn folded(
    (law, memory): (&BendingLaw, &Memory),
    (bow, normal): (Vector, Vector),
    (spacing, fold): (f64, f64),
    definite: bool,
) -> (Vector, Block, f64) {
    let along = dot(bow, normal);
    let to = curvature(bow, normal, spacing);
    let law = BendingLaw { rest_curvature: law.rest_curvature + fold, ..*law };
    let response = law.respond(memory, to);
    let (first, second) = Angle::of(along * along, spacing).derivatives(along);
    let slope = response.tangent * first * first + response.load * second;
    let slope = if definite { slope.max(0.0) } else { slope };
    let within = subtract(bow, scale(normal, along));
    let size = dot(within, within).sqrt();
    let inner = law.backbone.respond(size);
    let (secant, unit) = if size > 0.0 {
        (inner.load / size, scale(within, 1.0 / size))
    } else {
        (inner.tangent, within)
    };
    let moment = add(scale(normal, response.load * first), scale(within, secant));
    let block = sum([
        (slope, outer(normal, normal)),
        (secant, sum([(1.0, one()), (-1.0, outer(normal, normal))])),
        (inner.tangent - secant, outer(unit, unit)),
    ]);
    let friction = law.friction.work(memory.friction, to - memory.position);
    let energy = law.backbone.energy(to - law.rest_curvature) + friction;
    (moment, block, energy + law.backbone.energy(size))
}

/// Curvature of a bow about a normal.
pub(crate) fn curvature(bow: Vector, normal: Vector, length: f64) -> f64 {
    let bow = dot(bow, normal);
    Angle::of(bow * bow, length).curvature(bow)
}

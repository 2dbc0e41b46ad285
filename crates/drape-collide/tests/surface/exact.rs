//! Exact geometry of simplices, by separating directions, and proofs about moving ones.
//!
//! Nothing here knows how the crate finds closest points, planes or orientations.

use num_bigint::BigInt;
use std::ops::{Add, Mul, Sub};

pub type Place<T> = [T; 3];

/// Numbers with exact or floating arithmetic.
pub trait Number:
    Clone + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
}
impl<T> Number for T where
    T: Clone + PartialOrd + Add<Output = T> + Sub<Output = T> + Mul<Output = T>
{
}

pub fn sub<T: Number>(a: &Place<T>, b: &Place<T>) -> Place<T> {
    std::array::from_fn(|k| a[k].clone() - b[k].clone())
}

pub fn dot<T: Number>(a: &Place<T>, b: &Place<T>) -> T {
    let term = |k: usize| a[k].clone() * b[k].clone();
    term(0) + term(1) + term(2)
}

fn cross<T: Number>(a: &Place<T>, b: &Place<T>) -> Place<T> {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone()
    })
}

/// The part of `a` across `b`, times the square of `b`.
fn across<T: Number>(a: &Place<T>, b: &Place<T>) -> Place<T> {
    let (bb, ab) = (dot(b, b), dot(a, b));
    std::array::from_fn(|k| bb.clone() * a[k].clone() - ab.clone() * b[k].clone())
}

fn edges<T: Number>(points: &[Place<T>]) -> Vec<[&Place<T>; 2]> {
    let pairs = (0..points.len()).flat_map(|i| (i + 1..points.len()).map(move |j| [i, j]));
    pairs.map(|pair| pair.map(|k| &points[k])).collect()
}

/// Directions one of which leads along the shortest displacement between two simplices of up to
/// three points: that from a point to a point, an edge or a face, or from an edge to an edge.
fn directions<T: Number>(a: &[Place<T>], b: &[Place<T>]) -> Vec<Place<T>> {
    let mut all = Vec::new();
    for p in a {
        all.extend(b.iter().map(|q| sub(p, q)));
    }
    for (points, others) in [(a, b), (b, a)] {
        for [from, to] in edges(others) {
            let along = sub(to, from);
            all.extend(points.iter().map(|p| across(&sub(p, from), &along)));
        }
        if let [p, q, r] = points {
            all.push(cross(&sub(q, p), &sub(r, p)));
        }
    }
    for [p, q] in edges(a) {
        all.extend(edges(b).into_iter().map(|[r, s]| cross(&sub(q, p), &sub(s, r))));
    }
    all
}

/// Lowest of the heights of the one less highest of the other, along a direction.
fn clearance<T: Number>(direction: &Place<T>, a: &[Place<T>], b: &[Place<T>]) -> T {
    let heights = |points: &[Place<T>]| -> Vec<T> {
        points.iter().map(|point| dot(direction, point)).collect()
    };
    let lower = |a: T, b: T| if b < a { b } else { a };
    let higher = |a: T, b: T| if b > a { b } else { a };
    let low = heights(a).into_iter().reduce(lower).unwrap();
    low - heights(b).into_iter().reduce(higher).unwrap()
}

/// Whether two simplices have no point in common: exact if the numbers are.
pub fn apart<T: Number>(a: &[Place<T>], b: &[Place<T>]) -> bool {
    let zero = a[0][0].clone() - a[0][0].clone();
    let parts = |d: &Place<T>| clearance(d, a, b) > zero || clearance(d, b, a) > zero;
    directions(a, b).iter().any(parts)
}

/// The number times two to the given power, which must make it whole.
fn whole(value: f64, power: i32) -> BigInt {
    if value == 0.0 {
        return BigInt::from(0);
    }
    let (mantissa, exponent) = parts(value);
    BigInt::from(mantissa) << u32::try_from(exponent + power).unwrap()
}

/// A number as mantissa times two to a power.
fn parts(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let (sign, exponent) = (if bits >> 63 == 0 { 1 } else { -1 }, (bits >> 52 & 0x7ff) as i32);
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    if exponent == 0 {
        (sign * fraction, -1074)
    } else {
        let mantissa = sign * (fraction | 1 << 52);
        // Of a mantissa with zeros at its end the power is as large as can be.
        let zeros = mantissa.trailing_zeros() as i32;
        (mantissa >> zeros, exponent - 1075 + zeros)
    }
}

/// Points that move straight and evenly from one place to another, with exact coordinates.
pub struct Motion {
    start: Vec<Place<BigInt>>,
    end: Vec<Place<BigInt>>,
    /// The same relative to the first point, for directions to try.
    near: Vec<[Place<f64>; 2]>,
    /// Coordinates are in units of two to minus this.
    power: i32,
}

/// A time: a whole number over two to a level.
#[derive(Clone, Copy)]
struct Time {
    count: u64,
    level: u32,
}

/// Deepest division of a motion in a proof.
const DEEPEST: u32 = 24;

/// Divisions in all that a proof may take.
const TRIES: usize = 30_000;

impl Motion {
    pub fn new(start: &[Place<f64>], end: &[Place<f64>], target: f64) -> Motion {
        let values = start.iter().chain(end).flatten().chain([&target]);
        let powers = values.filter(|value| **value != 0.0).map(|value| -parts(*value).1);
        let power = powers.max().unwrap_or(0);
        let exact = |places: &[Place<f64>]| -> Vec<Place<BigInt>> {
            places.iter().map(|place| place.map(|value| whole(value, power))).collect()
        };
        let near = start.iter().zip(end).map(|(a, b)| [sub(a, &start[0]), sub(b, &start[0])]);
        Motion { start: exact(start), end: exact(end), near: near.collect(), power }
    }

    /// Exact places at a time, times two to its level.
    fn places(&self, time: Time) -> Vec<Place<BigInt>> {
        let rest = (1u64 << time.level) - time.count;
        let place = |(a, b): (&Place<BigInt>, &Place<BigInt>)| {
            std::array::from_fn(|k| &a[k] * rest + &b[k] * time.count)
        };
        self.start.iter().zip(&self.end).map(place).collect()
    }

    fn rough(&self, time: f64) -> Vec<Place<f64>> {
        let place = |[a, b]: &[Place<f64>; 2]| std::array::from_fn(|k| a[k] + time * (b[k] - a[k]));
        self.near.iter().map(place).collect()
    }

    /// Directions from the points of `b` to those of `a`, the most promising first, as whole
    /// numbers; how far they part at two times is estimated.
    fn promising(&self, a: &[usize], b: &[usize], times: [f64; 2]) -> Vec<Place<BigInt>> {
        let middle = self.rough(0.5 * (times[0] + times[1]));
        let ends = times.map(|time| self.rough(time));
        let pick = |points: &[Place<f64>], list: &[usize]| -> Vec<Place<f64>> {
            list.iter().map(|&k| points[k]).collect()
        };
        let mut found = Vec::new();
        for direction in directions(&pick(&middle, a), &pick(&middle, b)) {
            for sign in [1.0, -1.0] {
                let largest = direction.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
                if largest == 0.0 {
                    continue;
                }
                let direction = direction.map(|v| sign * v / largest);
                let length = dot(&direction, &direction).sqrt();
                let least = ends.iter().map(|points| {
                    clearance(&direction, &pick(points, a), &pick(points, b)) / length
                });
                found.push((least.fold(f64::INFINITY, f64::min), direction));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let whole = |v: f64| BigInt::from((v * 2f64.powi(52)) as i64);
        found.into_iter().map(|(_, direction)| direction.map(whole)).collect()
    }

    /// Whether the points of `a` and `b` keep a distance on the whole displacement: a proof if
    /// true.
    ///
    /// One plane between the two at the start and at the end is one all the displacement, for
    /// heights over it change evenly. Where there is none the displacement is halved.
    pub fn keeps(&self, a: &[usize], b: &[usize], distance: f64) -> bool {
        let mut tries = TRIES;
        self.keeps_within([a, b], (distance, Time { count: 0, level: 0 }), &mut tries)
    }

    /// Whether the points are a distance apart at the start; exactly, and slowly.
    pub fn starts_apart_by(&self, a: &[usize], b: &[usize], distance: f64) -> bool {
        let pick = |list: &[usize]| -> Vec<Place<BigInt>> {
            list.iter().map(|&k| self.start[k].clone()).collect()
        };
        let (a, b) = (pick(a), pick(b));
        let (zero, target) = (BigInt::from(0), whole(distance, self.power));
        directions(&a, &b).iter().any(|direction| {
            let least = &target * &target * dot(direction, direction);
            let sides = [clearance(direction, &a, &b), clearance(direction, &b, &a)];
            sides.iter().any(|clear| *clear > zero && clear * clear >= least)
        })
    }

    fn keeps_within(
        &self,
        [a, b]: [&[usize]; 2],
        (distance, from): (f64, Time),
        tries: &mut usize,
    ) -> bool {
        if *tries == 0 {
            return false;
        }
        *tries -= 1;
        let to = Time { count: from.count + 1, ..from };
        let scale = 2f64.powi(from.level as i32);
        let times = [from, to].map(|time| time.count as f64 / scale);
        let places = [from, to].map(|time| self.places(time));
        let target = whole(distance, self.power) << from.level;
        let zero = BigInt::from(0);
        let proves = |direction: &Place<BigInt>| {
            let least = &target * &target * dot(direction, direction);
            places.iter().all(|points| {
                let pick = |list: &[usize]| -> Vec<Place<BigInt>> {
                    list.iter().map(|&k| points[k].clone()).collect()
                };
                let clear = clearance(direction, &pick(a), &pick(b));
                clear > zero && &clear * &clear >= least
            })
        };
        if self.promising(a, b, times).iter().take(3).any(proves) {
            return true;
        }
        let halves = [0, 1].map(|k| Time { count: 2 * from.count + k, level: from.level + 1 });
        from.level < DEEPEST
            && halves.into_iter().all(|half| self.keeps_within([a, b], (distance, half), tries))
    }

    /// Whether two sets of points are apart at a share `count / 2^level` of the displacement,
    /// exactly.
    pub fn apart_at(&self, a: &[usize], b: &[usize], (count, level): (u64, u32)) -> bool {
        let places = self.places(Time { count, level });
        let pick = |list: &[usize]| -> Vec<Place<BigInt>> {
            list.iter().map(|&k| places[k].clone()).collect()
        };
        let (a_places, b_places) = (pick(a), pick(b));
        let time = count as f64 / 2f64.powi(level as i32);
        let zero = BigInt::from(0);
        let mut quick = self.promising(a, b, [time, time]).into_iter().take(2);
        quick.any(|d| clearance(&d, &a_places, &b_places) > zero) || apart(&a_places, &b_places)
    }
}

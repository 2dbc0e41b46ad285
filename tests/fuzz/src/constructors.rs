//! Public constructors and entries with data of any kind: not a number, infinite, empty, too short,
//! too long, out of range. None of them may panic; an error is as good as a result.

mod changed_scene;
mod cloth;
mod contact;
mod curves;
mod frames;
mod least_squares;
mod solver;

use crate::shapes::Source;

/// Numbers that stand at the ends of what constructors expect.
const ODD: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e308,
    -1e308,
    1e-308,
    5e-324,
    1e-12,
    1e12,
    0.5,
    1e3,
    -1e-3,
];

impl Source<'_> {
    /// Returns an odd number, or an ordinary one.
    fn odd(&mut self) -> f64 {
        match self.below(4) {
            0 => ODD[self.below(ODD.len() as u64) as usize],
            1 => self.power(-9.0, 9.0),
            _ => self.between(-1.0, 1.0),
        }
    }

    /// Returns a positive number, or, one time in `rarity`, an odd one.
    fn mostly_positive(&mut self, rarity: u64) -> f64 {
        if self.below(rarity) == 0 { self.odd() } else { self.power(-3.0, 1.0) }
    }

    /// Returns a list of odd numbers, whose length is `length` or near it.
    fn odd_list(&mut self, length: usize) -> Vec<f64> {
        let length = self.length(length);
        let ordinary = self.below(2) == 0;
        (0..length).map(|_| if ordinary { self.coordinate() } else { self.odd() }).collect()
    }

    /// Returns `length`, or a number near it, or 0.
    fn length(&mut self, length: usize) -> usize {
        match self.below(8) {
            0 => 0,
            1 => length + 1,
            2 => length.saturating_sub(1),
            _ => length,
        }
    }

    /// Returns the number of a vertex below `count`, or one beyond.
    fn number(&mut self, count: usize) -> u32 {
        match self.below(24) {
            0 => u32::MAX,
            1 => count as u32,
            _ => self.below(count.max(1) as u64) as u32,
        }
    }

    /// Returns up to `most` triangles with corners among `count` vertices, or beside them.
    fn triangles(&mut self, most: u64, count: usize) -> Vec<[u32; 3]> {
        (0..self.below(most)).map(|_| [0; 3].map(|_| self.number(count))).collect()
    }

    /// Returns up to `most` points, some with odd coordinates.
    fn odd_points(&mut self, most: u64) -> Vec<[f64; 3]> {
        let odd = self.below(3) == 0;
        (0..self.below(most))
            .map(|_| if odd { [0; 3].map(|_| self.odd()) } else { self.point() })
            .collect()
    }
}

/// Calls the constructors of one crate, which the bytes choose.
pub fn call(bytes: &[u8]) {
    let source = &mut Source::new(bytes);
    match source.below(10) {
        0 => least_squares::fit(source),
        1 => least_squares::friction(source),
        2 => solver::step(source),
        3 => solver::matrix(source),
        4 => cloth::evaluate(source),
        5 => contact::surfaces(source),
        6 => contact::bodies(source),
        7 => frames::recording(source),
        8 => curves::identify(source),
        _ => changed_scene::simulate(source),
    }
}

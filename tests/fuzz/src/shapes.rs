//! Numbers and points drawn from bytes: many of them special.

use arbitrary::Unstructured;

use crate::rational::Point;

/// Source of numbers; once its bytes are used up all are 0.
pub struct Source<'a>(Unstructured<'a>);

impl<'a> Source<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    pub fn whole(&mut self) -> u64 {
        self.0.arbitrary().unwrap_or_default()
    }

    /// Returns a number below another.
    pub fn below(&mut self, end: u64) -> u64 {
        u64::from(self.0.arbitrary::<u32>().unwrap_or_default()) % end
    }

    /// Returns a number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.whole() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a power of ten with an exponent between two others.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.between(low, high))
    }

    /// Returns a number of -1 to 1: any, one of few, or one beside those.
    pub fn coordinate(&mut self) -> f64 {
        let few = self.below(9) as f64 / 4.0 - 1.0;
        match self.below(8) {
            0..=3 => self.between(-1.0, 1.0),
            4 | 5 => few,
            6 => few + self.between(-1.0, 1.0) * self.power(-16.0, -3.0),
            _ => [few.next_up(), few.next_down()][self.below(2) as usize],
        }
    }

    pub fn point(&mut self) -> Point {
        [0; 3].map(|_| self.coordinate())
    }

    /// Returns some points: a quarter of them lie on lines of two, or in planes of three, that are
    /// there already, to rounding.
    pub fn points<const N: usize>(&mut self) -> [Point; N] {
        let mut points = [[0.0; 3]; N];
        for k in 0..N {
            let [i, j] = [0; 2].map(|_| self.below(k.max(1) as u64) as usize);
            let (from, to, along) = (points[i], points[j], self.between(-0.5, 1.5));
            points[k] = self.point();
            if k > 1 && self.below(4) == 0 {
                points[k] = std::array::from_fn(|x| from[x] + along * (to[x] - from[x]));
            }
        }
        points
    }
}

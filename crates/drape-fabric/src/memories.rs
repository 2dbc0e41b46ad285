use crate::batch::{BatchLaw, LANES, Lanes};
use crate::law::Memory;

/// Columns of [`Memories`]: the deformation, the two loads of the friction, the largest deformation,
/// and the two numbers of [`BatchLaw::toe`].
const COLUMNS: usize = 6;
const POSITION: usize = 0;
const FRICTION: [usize; 2] = [1, 2];
const PEAK: usize = 3;
const TOE: [usize; 2] = [4, 5];

/// Memories of many connectors, column by column; what [`Memory`] is for one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memories([Vec<f64>; COLUMNS]);

/// Memories of [`LANES`] neighbours.
#[derive(Debug, Clone, Copy)]
pub struct Remembered<'a>([&'a Lanes; COLUMNS]);

/// Memories of some neighbours, to be moved on.
#[derive(Debug)]
pub struct Moving<'a>([&'a mut [f64]; COLUMNS]);

/// The memory of one lane, without the friction.
#[derive(Debug, Clone, Copy)]
pub struct Lane {
    /// Deformation when the memory was last written.
    pub position: f64,
    /// Largest deformation ever reached.
    pub peak: f64,
    /// See [`BatchLaw::toe`].
    pub toe: [f64; 2],
}

fn lanes(column: &[f64], start: usize) -> &Lanes {
    column[start..]
        .first_chunk()
        .expect("columns end a batch after the last place that is asked for")
}

impl Memories {
    /// As many memories as asked for, all virgin, of a law.
    #[must_use]
    pub fn new(law: &impl BatchLaw, count: usize) -> Self {
        let mut memories = Self::default();
        memories.extend(law, count);
        memories
    }

    /// Adds virgin memories of a law.
    pub fn extend(&mut self, law: &impl BatchLaw, count: usize) {
        let [end, slope] = law.toe(0.0);
        let length = self.0[POSITION].len() + count;
        for (column, value) in self.0.iter_mut().zip([0.0, 0.0, 0.0, 0.0, end, slope]) {
            column.resize(length, value);
        }
    }

    /// One of the memories.
    #[must_use]
    pub fn get(&self, index: usize) -> Memory {
        Memory {
            position: self.0[POSITION][index],
            friction: FRICTION.map(|column| self.0[column][index]),
            peak: self.0[PEAK][index],
        }
    }

    /// All memories, in the order of their places.
    pub fn iter(&self) -> impl Iterator<Item = Memory> {
        (0..self.0[POSITION].len()).map(|index| self.get(index))
    }

    /// Makes the [`LANES`] memories from `start` on those of connectors that were brought to the given
    /// deformations without friction.
    pub fn start(&mut self, law: &impl BatchLaw, start: usize, deformations: &Lanes) {
        for (index, &deformation) in (start..).zip(deformations) {
            let peak = law.peak(0.0, deformation);
            let [end, slope] = law.toe(peak);
            let memory = [deformation, 0.0, 0.0, peak, end, slope];
            for (column, value) in self.0.iter_mut().zip(memory) {
                column[index] = value;
            }
        }
    }

    /// Deformations when the memories were last written, in the unit of the deformation.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.0[POSITION]
    }

    /// The [`LANES`] memories from `start` on, which must exist.
    #[inline(always)]
    #[must_use]
    pub fn from(&self, start: usize) -> Remembered<'_> {
        Remembered(self.0.each_ref().map(|column| lanes(column, start)))
    }

    /// All memories from `start` on, to be moved on.
    pub fn moving(&mut self, start: usize) -> Moving<'_> {
        Moving(self.0.each_mut().map(|column| &mut column[start..]))
    }
}

impl Moving<'_> {
    /// The first `count` memories and the others.
    #[must_use]
    pub fn split(self, count: usize) -> (Self, Self) {
        let [a, b, c, d, e, f] = self.0.map(|column| column.split_at_mut(count));
        (Self([a.0, b.0, c.0, d.0, e.0, f.0]), Self([a.1, b.1, c.1, d.1, e.1, f.1]))
    }

    #[inline(always)]
    pub(crate) fn from(&self, start: usize) -> Remembered<'_> {
        Remembered(self.0.each_ref().map(|column| lanes(column, start)))
    }

    /// Writes the deformation and the peak of a batch, and where there are elements their loads.
    #[inline(always)]
    pub(crate) fn write(
        &mut self,
        start: usize,
        (position, peak): (&Lanes, &Lanes),
        friction: [Option<&Lanes>; 2],
    ) {
        let mut put = |column: usize, values: &Lanes| {
            self.0[column][start..start + LANES].copy_from_slice(values);
        };
        put(POSITION, position);
        put(PEAK, peak);
        for (column, loads) in FRICTION.into_iter().zip(friction) {
            if let Some(loads) = loads {
                put(column, loads);
            }
        }
    }

    /// Brings what follows from the peaks of a batch up to date.
    #[inline(always)]
    pub(crate) fn age(&mut self, law: &(impl BatchLaw + ?Sized), start: usize) {
        for index in start..start + LANES {
            let toe = law.toe(self.0[PEAK][index]);
            for (column, value) in TOE.into_iter().zip(toe) {
                self.0[column][index] = value;
            }
        }
    }
}

impl<'a> Remembered<'a> {
    /// Deformations when the memories were last written.
    #[inline(always)]
    pub(crate) fn position(&self) -> &'a Lanes {
        self.0[POSITION]
    }

    /// Loads of one of the friction's elements.
    #[inline(always)]
    pub(crate) fn friction(&self, element: usize) -> &'a Lanes {
        self.0[FRICTION[element]]
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Lane {
        Lane {
            position: self.0[POSITION][lane],
            peak: self.0[PEAK][lane],
            toe: TOE.map(|column| self.0[column][lane]),
        }
    }
}

//! Eight numbers side by side, and columns of them, in arithmetic that the compiler turns into
//! vector instructions.
//!
//! The number of lanes is fixed and no operation is fused, so every machine computes equal bits
//! with any instruction set. No closure is passed to a function of another crate, such as an
//! array's `map`: such functions are compiled without the machine's vector instructions.

use core::ops::{Add, Mul, Sub};

/// Number of lanes: one register of the widest instructions in double precision. The number is
/// small enough that the short levels of a level schedule fill the lanes.
pub(crate) const LANES: usize = 8;

macro_rules! lanes {
    ($name:ident, $number:ty, $align:literal) => {
        #[derive(Clone, Copy, Debug)]
        #[repr(align($align))]
        pub(crate) struct $name(pub [$number; LANES]);

        impl $name {
            pub(crate) const ZERO: Self = Self([0.0; LANES]);

            #[inline(always)]
            pub(crate) fn load(column: &[$number], at: usize) -> Self {
                let mut lanes = [0.0; LANES];
                lanes.copy_from_slice(&column[at..at + LANES]);
                Self(lanes)
            }

            #[inline(always)]
            pub(crate) fn store(self, column: &mut [$number], at: usize) {
                column[at..at + LANES].copy_from_slice(&self.0);
            }
        }

        impl Add for $name {
            type Output = Self;

            #[inline(always)]
            fn add(mut self, other: Self) -> Self {
                for (a, b) in self.0.iter_mut().zip(other.0) {
                    *a += b;
                }
                self
            }
        }

        impl Sub for $name {
            type Output = Self;

            #[inline(always)]
            fn sub(mut self, other: Self) -> Self {
                for (a, b) in self.0.iter_mut().zip(other.0) {
                    *a -= b;
                }
                self
            }
        }

        impl Mul for $name {
            type Output = Self;

            #[inline(always)]
            fn mul(mut self, other: Self) -> Self {
                for (a, b) in self.0.iter_mut().zip(other.0) {
                    *a *= b;
                }
                self
            }
        }

        impl Number for $number {
            #[inline(always)]
            fn splat(x: f64) -> Self {
                x as $number
            }

            #[inline(always)]
            fn root_and_inverse(self) -> [Self; 2] {
                let root = if self > 0.0 { self.sqrt() } else { 0.0 };
                [root, if root > 0.0 { 1.0 / root } else { 0.0 }]
            }
        }

        impl Number for $name {
            #[inline(always)]
            fn splat(x: f64) -> Self {
                Self([x as $number; LANES])
            }

            #[inline(always)]
            fn root_and_inverse(self) -> [Self; 2] {
                let mut roots = [Self::ZERO; 2];
                let [root, inverse] = &mut roots;
                // Branches would keep the compiler from using vector instructions.
                for ((root, inverse), x) in root.0.iter_mut().zip(&mut inverse.0).zip(self.0) {
                    let positive = if x > 0.0 { x } else { 0.0 };
                    *root = positive.sqrt();
                    let divisor = if *root > 0.0 { *root } else { <$number>::INFINITY };
                    *inverse = 1.0 / divisor;
                }
                roots
            }
        }
    };
}

lanes!(Double, f64, 64);
lanes!(Single, f32, 32);

/// One number, or one number per lane.
pub(crate) trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
    /// Returns `x` in every lane.
    fn splat(x: f64) -> Self;

    /// Returns the square root of `self` and its inverse. Both are 0 where `self` is not positive.
    fn root_and_inverse(self) -> [Self; 2];
}

impl Double {
    #[inline(always)]
    pub(crate) fn narrow(self) -> Single {
        let mut lanes = Single::ZERO;
        for (lane, x) in lanes.0.iter_mut().zip(self.0) {
            *lane = x as f32;
        }
        lanes
    }
}

impl Single {
    #[inline(always)]
    pub(crate) fn widen(self) -> Double {
        let mut lanes = Double::ZERO;
        for (lane, x) in lanes.0.iter_mut().zip(self.0) {
            *lane = x.into();
        }
        lanes
    }
}

/// Converts `short` to double precision.
#[inline(always)]
pub(crate) fn widened<const N: usize>(short: &[Single; N]) -> [Double; N] {
    let mut wide = [Double::ZERO; N];
    for (wide, short) in wide.iter_mut().zip(short) {
        *wide = short.widen();
    }
    wide
}

/// Converts `wide` to single precision.
#[inline(always)]
pub(crate) fn narrowed<const N: usize>(wide: &[Double; N]) -> [Single; N] {
    let mut short = [Single::ZERO; N];
    for (short, wide) in short.iter_mut().zip(wide) {
        *short = wide.narrow();
    }
    short
}

/// Three numbers per row, as one column per axis.
#[derive(Clone, Debug)]
pub(crate) struct Columns<T>(pub [Vec<T>; 3]);

impl<T: Copy + Default> Columns<T> {
    pub(crate) fn new(rows: usize) -> Self {
        Self(core::array::from_fn(|_| vec![T::default(); rows]))
    }
}

impl<T: Copy> Columns<T> {
    /// Returns the numbers of `row`.
    #[inline(always)]
    pub(crate) fn at(&self, row: usize) -> [T; 3] {
        let [x, y, z] = &self.0;
        [x[row], y[row], z[row]]
    }
}

impl Columns<f64> {
    #[inline(always)]
    pub(crate) fn load(&self, at: usize) -> [Double; 3] {
        let [x, y, z] = &self.0;
        [Double::load(x, at), Double::load(y, at), Double::load(z, at)]
    }
}

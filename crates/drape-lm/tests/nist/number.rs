//! Plain numbers and dual numbers, which carry their derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Largest number of parameters of a reference problem.
const MOST: usize = 9;

/// Arithmetic that the models need.
pub trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    fn inverse(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn atan(self) -> Self;
}

impl Number for f64 {
    fn inverse(self) -> Self {
        1.0 / self
    }
    fn exp(self) -> Self {
        self.exp()
    }
    fn ln(self) -> Self {
        self.ln()
    }
    fn sin(self) -> Self {
        self.sin()
    }
    fn cos(self) -> Self {
        self.cos()
    }
    fn atan(self) -> Self {
        self.atan()
    }
}

/// Dual number: a value with its derivatives by all parameters.
#[derive(Clone, Copy)]
pub struct Dual {
    pub value: f64,
    pub slope: [f64; MOST],
}

impl Dual {
    /// Returns the parameters as independent variables.
    pub fn variables(parameters: &[f64]) -> Vec<Self> {
        let variable = |(j, &value): (usize, &f64)| {
            let mut slope = [0.0; MOST];
            slope[j] = 1.0;
            Self { value, slope }
        };
        parameters.iter().enumerate().map(variable).collect()
    }

    /// Returns a function of this number from its value and its derivative there.
    fn map(self, value: f64, derivative: f64) -> Self {
        Self { value, slope: self.slope.map(|slope| derivative * slope) }
    }
}

impl Number for Dual {
    fn inverse(self) -> Self {
        self.map(1.0 / self.value, -1.0 / (self.value * self.value))
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.map(value, value)
    }
    fn ln(self) -> Self {
        self.map(self.value.ln(), 1.0 / self.value)
    }
    fn sin(self) -> Self {
        self.map(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.map(self.value.cos(), -self.value.sin())
    }
    fn atan(self) -> Self {
        self.map(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(-self.value, -1.0)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self.value += other.value;
        for (a, b) in self.slope.iter_mut().zip(other.slope) {
            *a += b;
        }
        self
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut product = self.map(self.value * other.value, other.value);
        for (a, b) in product.slope.iter_mut().zip(other.slope) {
            *a += self.value * b;
        }
        product
    }
}

impl Div for Dual {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        self * other.inverse()
    }
}

impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self.map(self.value + other, 1.0)
    }
}

impl Sub<f64> for Dual {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self.map(self.value - other, 1.0)
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self.map(self.value * other, other)
    }
}

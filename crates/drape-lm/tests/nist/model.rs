//! Models of the reference problems, for plain and for dual numbers.

use std::f64::consts::PI;

use crate::number::{Dual, Number};

/// Model for both kinds of numbers.
#[derive(Clone, Copy)]
pub struct Model {
    pub plain: fn(&[f64], &[f64]) -> f64,
    pub dual: fn(&[Dual], &[f64]) -> Dual,
}

macro_rules! both {
    ($model:ident) => {
        Model { plain: $model::<f64>, dual: $model::<Dual> }
    };
}

/// Names of the problems with their models.
pub const MODELS: [(&str, Model); 27] = [
    ("Bennett5", both!(bennett5)),
    ("BoxBOD", both!(misra1a)),
    ("Chwirut1", both!(chwirut)),
    ("Chwirut2", both!(chwirut)),
    ("DanWood", both!(danwood)),
    ("ENSO", both!(enso)),
    ("Eckerle4", both!(eckerle4)),
    ("Gauss1", both!(gauss)),
    ("Gauss2", both!(gauss)),
    ("Gauss3", both!(gauss)),
    ("Hahn1", both!(cubic_over_cubic)),
    ("Kirby2", both!(kirby2)),
    ("Lanczos1", both!(lanczos)),
    ("Lanczos2", both!(lanczos)),
    ("Lanczos3", both!(lanczos)),
    ("MGH09", both!(mgh09)),
    ("MGH10", both!(mgh10)),
    ("MGH17", both!(mgh17)),
    ("Misra1a", both!(misra1a)),
    ("Misra1b", both!(misra1b)),
    ("Misra1c", both!(misra1c)),
    ("Misra1d", both!(misra1d)),
    ("Nelson", both!(nelson)),
    ("Rat42", both!(rat42)),
    ("Rat43", both!(rat43)),
    ("Roszman1", both!(roszman1)),
    ("Thurber", both!(cubic_over_cubic)),
];

fn bennett5<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * ((b[1] + x[0]).ln() / -b[2]).exp()
}

fn chwirut<T: Number>(b: &[T], x: &[f64]) -> T {
    (-b[0] * x[0]).exp() / (b[1] + b[2] * x[0])
}

fn danwood<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * (b[1] * x[0].ln()).exp()
}

fn enso<T: Number>(b: &[T], x: &[f64]) -> T {
    let turn = 2.0 * PI * x[0];
    let wave = |period: T, cosine: T, sine: T| {
        let angle = period.inverse() * turn;
        cosine * angle.cos() + sine * angle.sin()
    };
    let year = turn / 12.0;
    b[0] + b[1] * year.cos() + b[2] * year.sin() + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8])
}

fn eckerle4<T: Number>(b: &[T], x: &[f64]) -> T {
    let z = (b[2] - x[0]) / b[1];
    b[0] / b[1] * (z * z * -0.5).exp()
}

fn gauss<T: Number>(b: &[T], x: &[f64]) -> T {
    let peak = |height: T, middle: T, width: T| {
        let z = (middle - x[0]) / width;
        height * (-(z * z)).exp()
    };
    b[0] * (-b[1] * x[0]).exp() + peak(b[2], b[3], b[4]) + peak(b[5], b[6], b[7])
}

fn cubic_over_cubic<T: Number>(b: &[T], x: &[f64]) -> T {
    let x = x[0];
    (b[0] + (b[1] + (b[2] + b[3] * x) * x) * x) / ((b[4] + (b[5] + b[6] * x) * x) * x + 1.0)
}

fn kirby2<T: Number>(b: &[T], x: &[f64]) -> T {
    let x = x[0];
    (b[0] + (b[1] + b[2] * x) * x) / ((b[3] + b[4] * x) * x + 1.0)
}

fn lanczos<T: Number>(b: &[T], x: &[f64]) -> T {
    let decay = |amount: T, rate: T| amount * (-rate * x[0]).exp();
    decay(b[0], b[1]) + decay(b[2], b[3]) + decay(b[4], b[5])
}

fn mgh09<T: Number>(b: &[T], x: &[f64]) -> T {
    let x = x[0];
    b[0] * ((b[1] + x) * x) / ((b[2] + x) * x + b[3])
}

fn mgh10<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * (b[1] / (b[2] + x[0])).exp()
}

fn mgh17<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] + b[1] * (-b[3] * x[0]).exp() + b[2] * (-b[4] * x[0]).exp()
}

fn misra1a<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * (-(-b[1] * x[0]).exp() + 1.0)
}

fn misra1b<T: Number>(b: &[T], x: &[f64]) -> T {
    let z = (b[1] * (0.5 * x[0]) + 1.0).inverse();
    b[0] * (-(z * z) + 1.0)
}

fn misra1c<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * (-((b[1] * (2.0 * x[0]) + 1.0).ln() * -0.5).exp() + 1.0)
}

fn misra1d<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] * b[1] * x[0] / (b[1] * x[0] + 1.0)
}

fn nelson<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] - b[1] * x[0] * (-b[2] * x[1]).exp()
}

fn rat42<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] / ((b[1] - b[2] * x[0]).exp() + 1.0)
}

fn rat43<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] / (((b[1] - b[2] * x[0]).exp() + 1.0).ln() / b[3]).exp()
}

fn roszman1<T: Number>(b: &[T], x: &[f64]) -> T {
    b[0] - b[1] * x[0] - (b[2] / (-b[3] + x[0])).atan() * (1.0 / PI)
}

//! Numbers as a file gives them: a bare number in the unit of the key, or a text with a number and
//! a unit.
//!
//! A structure that mirrors a file has a [`Given`] with a [`Dimension`] for each quantity.
//! [`Document`](crate::Document) reads a [`Given`] from `0.01` and from `"10 mm"`. The check of the
//! structure converts the number to SI.
//!
//! A structure that has plain numbers names the dimension in `#[serde_as(as = "Length")]`.
//! [`Document`](crate::Document) then resolves the unit while it reads the number: the field has
//! the number in SI, and angles in degrees, as [`Given::value`] returns them. A bare length is in
//! the unit that the key `length` of the text names.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Mul;

use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_with::{DeserializeAs, SerializeAs};
#[cfg(feature = "schema")]
use {
    schemars::{JsonSchema, Schema, SchemaGenerator},
    serde_with::schemars_1::JsonSchemaAs,
    std::borrow::Cow,
};

use crate::unit::Quantity;

/// Number with a dimension, as a file gives it: a bare number, or a number with a unit.
///
/// ```
/// use drape_input::{Document, Given, Length};
///
/// #[derive(serde::Deserialize)]
/// struct Panel { width: Given<Length>, height: Given<Length> }
///
/// let panel: Panel = Document::new("a.toml", "width = 0.2\nheight = \"30 cm\"").decode()?;
/// // The bare number is in the unit of the file, here the metre.
/// assert_eq!([panel.width, panel.height].map(|length| length * 1.0), [0.2, 0.3]);
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
pub struct Given<D> {
    number: f64,
    /// Value of the unit in SI, if the file gives a unit.
    factor: Option<f64>,
    dimension: PhantomData<D>,
}

/// Dimension of a number, with the unit of bare numbers.
pub trait Dimension {
    /// Kind of quantity, which fixes the admissible units.
    const QUANTITY: Quantity;
    /// Value of the unit of a bare number in SI. 1 for lengths, which are in the unit of the file.
    const BARE: f64 = 1.0;
    /// Token by which [`Document`](crate::Document) recognises a [`Given`] of the dimension.
    const TOKEN: &'static str;
    /// Token by which [`Document`](crate::Document) recognises a resolved number of the dimension.
    const RESOLVED_TOKEN: &'static str;
    /// Unit of a bare number, in words.
    const UNIT: &'static str;
    /// Examples of a value: a bare number, and a number with a unit.
    const EXAMPLES: [&'static str; 2];
}

/// One degree, in radians.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// What the reader of a text needs to know of a dimension.
pub(crate) struct Token {
    pub(crate) quantity: Quantity,
    /// Examples of a value: a bare number, and a number with a unit.
    pub(crate) examples: [&'static str; 2],
    /// Value of the unit of a bare number in SI, if the number is to be resolved.
    pub(crate) resolved: Option<f64>,
    /// Whether a bare number is in the unit of lengths of the file, or in this unit per second.
    pub(crate) is_in_unit_of_file: bool,
}

macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident, $quantity:ident, $bare:expr, $unit:expr, $examples:expr;)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Clone, Copy, PartialEq)]
            pub struct $name;

            impl Dimension for $name {
                const QUANTITY: Quantity = Quantity::$quantity;
                const BARE: f64 = $bare;
                const UNIT: &'static str = $unit;
                const TOKEN: &'static str = concat!("$drape-input:", stringify!($name));
                const RESOLVED_TOKEN: &'static str =
                    concat!("$drape-input:resolved:", stringify!($name));
                const EXAMPLES: [&'static str; 2] = $examples;
            }

            impl<'de> DeserializeAs<'de, f64> for $name {
                fn deserialize_as<S: Deserializer<'de>>(deserializer: S) -> Result<f64, S::Error> {
                    deserializer.deserialize_newtype_struct($name::RESOLVED_TOKEN, NumberVisitor)
                }
            }

            impl SerializeAs<f64> for $name {
                fn serialize_as<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
                    serializer.serialize_f64(*number)
                }
            }

            #[cfg(feature = "schema")]
            impl JsonSchemaAs<f64> for $name {
                fn schema_name() -> Cow<'static, str> {
                    Given::<$name>::schema_name()
                }

                fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                    Given::<$name>::json_schema(generator)
                }
            }
        )*

        /// Returns what the reader needs to know of the dimension with the given `token`.
        pub(crate) fn token(token: &str) -> Option<Token> {
            match token {
                $($name::TOKEN | $name::RESOLVED_TOKEN => Some(Token {
                    quantity: Quantity::$quantity,
                    examples: $name::EXAMPLES,
                    resolved: (token == $name::RESOLVED_TOKEN).then_some($bare),
                    is_in_unit_of_file: $unit.starts_with("the unit of the file"),
                }),)*
                _ => None,
            }
        }
    };
}

dimensions! {
    /// Length. A bare number is in the unit of the file.
    ///
    /// ```
    /// use drape_input::{Document, Length};
    /// use serde_with::serde_as;
    ///
    /// #[serde_as]
    /// #[derive(serde::Deserialize)]
    /// struct Panel { length: String, #[serde_as(as = "[Length; 2]")] size: [f64; 2] }
    ///
    /// let text = "length = \"cm\"\nsize = [30, \"200 mm\"]\n";
    /// assert_eq!(Document::new("a.toml", text).decode::<Panel>()?.size, [0.3, 0.2]);
    /// # Ok::<(), drape_input::Diagnostics>(())
    /// ```
    Length, Length, 1.0, "the unit of the file", ["0.01", "10 mm"];
    /// Length that a bare number gives in m, whatever the unit of the file.
    Metres, Length, 1.0, "m", ["0.001", "1 mm"];
    /// Angle. A bare number is in degrees.
    Angle, Angle, DEGREE, "degrees", ["45", "45 deg"];
    /// Angular speed. A bare number is in degrees per second.
    AngularSpeed, AngularSpeed, DEGREE, "degrees/s", ["90", "90 deg/s"];
    /// Curvature. A bare number is in 1/m.
    Curvature, Curvature, 1.0, "1/m", ["20", "0.2 1/cm"];
    /// Time. A bare number is in s.
    Time, Time, 1.0, "s", ["0.5", "500 ms"];
    /// Velocity. A bare number is in the unit of the file per second.
    Velocity, Speed, 1.0, "the unit of the file per second", ["0.5", "0.5 m/s"];
    /// Speed. A bare number is in m/s.
    Speed, Speed, 1.0, "m/s", ["0.002", "2 mm/s"];
    /// Acceleration. A bare number is in m/s².
    Acceleration, Acceleration, 1.0, "m/s²", ["9.81", "9.81 m/s2"];
    /// Mass per area. A bare number is in kg/m².
    MassPerArea, MassPerArea, 1.0, "kg/m²", ["0.15", "150 g/m2"];
    /// Density. A bare number is in kg/m³.
    Density, Density, 1.0, "kg/m³", ["1.2", "1.2 kg/m3"];
    /// Force per width, or stiffness of a strip per width. A bare number is in N/m.
    ForcePerWidth, ForcePerWidth, 1.0, "N/m", ["5000", "50 N/cm"];
    /// Moment per width. A bare number is in N.
    MomentPerWidth, MomentPerWidth, 1.0, "N", ["0.0005", "0.05 gf.cm/cm"];
    /// Bending rigidity per width. A bare number is in N·m.
    BendingRigidity, BendingRigidity, 1.0, "N·m", ["1.2e-5", "0.12 gf.cm2/cm"];
    /// Shear stiffness. A bare number is in N/m, for a radian.
    ShearStiffness, ShearStiffness, 1.0, "N/m", ["35", "0.6 gf/(cm.deg)"];
    /// Pressure per distance. A bare number is in N/m³.
    PressurePerDistance, PressurePerDistance, 1.0, "N/m³", ["1e7", "10 kPa/mm"];
    /// Work per area. A bare number is in J/m².
    WorkPerArea, WorkPerArea, 1.0, "J/m²", ["2.5", "2.5 J/m2"];
    /// Height of a surface. A bare number is in m.
    Roughness, Roughness, 1.0, "m", ["5e-6", "5 um"];
    /// Ratio, such as a strain. A bare number is the ratio itself.
    Ratio, Ratio, 1.0, "", ["0.01", "1 %"];
}

impl<D: Dimension> Given<D> {
    /// Creates a bare `number`.
    #[must_use]
    pub const fn bare(number: f64) -> Self {
        Self { number, factor: None, dimension: PhantomData }
    }

    /// Returns the value in the unit of bare numbers: degrees for angles, the unit of the file for
    /// lengths, and SI for all other dimensions.
    ///
    /// For a length with a unit the value is in metres, whatever the unit of the file.
    #[must_use]
    pub fn value(self) -> f64 {
        match self.factor {
            None => self.number,
            Some(factor) if factor == D::BARE => self.number,
            Some(factor) => self.number * factor / D::BARE,
        }
    }

    /// Returns the number as the file gives it, without regard to its unit.
    #[must_use]
    pub fn number(self) -> f64 {
        self.number
    }
}

impl<D> Mul<f64> for Given<D> {
    type Output = f64;

    /// Returns the value in SI. `unit` is the value of the unit of bare numbers in SI. For lengths
    /// it is the unit of the file, in m.
    fn mul(self, unit: f64) -> f64 {
        self.number * self.factor.unwrap_or(unit)
    }
}

impl<D> Mul<Given<D>> for f64 {
    type Output = Given<D>;

    /// Returns `self` times the number `given`, in the unit of `given`.
    fn mul(self, given: Given<D>) -> Given<D> {
        Given { number: self * given.number, ..given }
    }
}

impl<D> Clone for Given<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Given<D> {}

impl<D> Default for Given<D> {
    fn default() -> Self {
        Self { number: 0.0, factor: None, dimension: PhantomData }
    }
}

impl<D> PartialEq for Given<D> {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number && self.factor == other.factor
    }
}

impl<D> fmt::Debug for Given<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.factor {
            None => write!(f, "{:?}", self.number),
            Some(factor) => write!(f, "{:?} × {factor:?}", self.number),
        }
    }
}

impl<D: Dimension> Serialize for Given<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.value())
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Given<D> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_newtype_struct(D::TOKEN, GivenVisitor(PhantomData))
    }
}

/// Visitor of a resolved number.
struct NumberVisitor;

impl<'de> Visitor<'de> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or text with a number and a unit")
    }

    fn visit_f64<E>(self, number: f64) -> Result<f64, E> {
        Ok(number)
    }

    fn visit_newtype_struct<S: Deserializer<'de>>(self, from: S) -> Result<f64, S::Error> {
        f64::deserialize(from)
    }
}

/// Visitor of a bare number, or of a pair of a number and the factor of its unit.
struct GivenVisitor<D>(PhantomData<D>);

impl<'de, D: Dimension> Visitor<'de> for GivenVisitor<D> {
    type Value = Given<D>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number, or text with a number and a unit of {}", D::QUANTITY.name())
    }

    fn visit_f64<E>(self, number: f64) -> Result<Self::Value, E> {
        Ok(Given::bare(number))
    }

    fn visit_newtype_struct<S: Deserializer<'de>>(self, from: S) -> Result<Self::Value, S::Error> {
        f64::deserialize(from).map(Given::bare)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut pair: A) -> Result<Self::Value, A::Error> {
        let number = pair.next_element()?.ok_or_else(|| A::Error::custom("no number"))?;
        let factor = pair.next_element()?.ok_or_else(|| A::Error::custom("no number"))?;
        Ok(Given { number, factor: Some(factor), dimension: PhantomData })
    }
}

/// Text, or a value of type `T`, for keys that accept a name as well as a table.
///
/// ```
/// use drape_input::{Document, TextOr};
///
/// #[derive(serde::Deserialize)]
/// struct Body { motion: TextOr<Vec<f64>> }
///
/// let body: Body = Document::new("a.toml", "motion = \"walk.pc2\"").decode()?;
/// assert_eq!(body.motion, TextOr::Text("walk.pc2".into()));
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum TextOr<T> {
    /// Text.
    Text(String),
    /// Value that is no text.
    Other(T),
}

/// Token by which [`Document`](crate::Document) recognises [`TextOr`].
pub(crate) const TEXT_OR: &str = "$drape-input:TextOr";

impl<'de, T: Deserialize<'de>> Deserialize<'de> for TextOr<T> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_newtype_struct(TEXT_OR, TextOrVisitor(PhantomData))
    }
}

/// Visitor of a text or of a value of type `T`.
struct TextOrVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TextOrVisitor<T> {
    type Value = TextOr<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("text, or a table")
    }

    fn visit_str<E>(self, text: &str) -> Result<Self::Value, E> {
        Ok(TextOr::Text(text.to_owned()))
    }

    fn visit_newtype_struct<S: Deserializer<'de>>(self, from: S) -> Result<Self::Value, S::Error> {
        T::deserialize(from).map(TextOr::Other)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(serde::de::value::MapAccessDeserializer::new(map)).map(TextOr::Other)
    }
}

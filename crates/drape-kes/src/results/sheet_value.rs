//! Values of one fabric on the way to a sheet.

use crate::results::average::{Averaged, rounded};
use crate::results::item::Item;
use crate::test::Direction;

/// Averaged value with its place in the files.
#[derive(Clone, Debug)]
pub(crate) struct Sourced {
    pub(crate) value: Averaged,
    pub(crate) source: String,
}

/// Value of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SheetValue {
    pub(crate) key: &'static str,
    pub(crate) direction: Option<Direction>,
    pub(crate) number: f64,
    pub(crate) deviation: Option<f64>,
    /// Spelling of the unit; `None` for a bare number.
    pub(crate) unit: Option<&'static str>,
    /// Where it comes from and how.
    pub(crate) why: String,
}

/// Values of a sheet, and what a sheet has no key for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Converted {
    pub(crate) values: Vec<SheetValue>,
    /// Values that stand in the files and have no use in the sheet, each with the reason.
    pub(crate) unused: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// Values of one fabric while they are converted.
pub(crate) struct Values {
    pub(crate) all: Vec<Sourced>,
}

impl Values {
    /// Returns the value of an item and a direction.
    pub(crate) fn get(&self, item: Item, direction: Option<Direction>) -> Option<&Sourced> {
        self.all.iter().find(|one| one.value.item == item && one.value.direction == direction)
    }

    /// Returns whether there is a value of an item in any direction.
    pub(crate) fn has(&self, item: Item) -> bool {
        self.all.iter().any(|one| one.value.item == item)
    }

    /// Returns whether there are values of FAST or of a cantilever, and none that only KES has.
    pub(crate) fn is_fast(&self) -> bool {
        let has = |is: fn(Item) -> bool| self.all.iter().any(|one| is(one.value.item));
        has(Item::is_of_fast) && !has(Item::is_of_kes)
    }

    /// Removes the value of an item and a direction.
    pub(crate) fn remove(&mut self, item: Item, direction: Option<Direction>) {
        self.all.retain(|one| (one.value.item, one.value.direction) != (item, direction));
    }
}

/// Returns where a value comes from.
pub(crate) fn why(one: &Sourced) -> String {
    let remark = &one.value.remark;
    let remark = if remark.is_empty() { String::new() } else { format!(": {remark}") };
    format!("{}{remark}", one.source)
}

/// Returns a computed number with its digits.
pub(crate) fn computed(number: f64) -> f64 {
    rounded(number, 5)
}

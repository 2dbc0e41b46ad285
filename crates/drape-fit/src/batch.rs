//! Many fabrics on all threads, in the memory of a few.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use drape_kes::Sheet;

use crate::{Error, Fit, Settings, identify_with};

/// Identifies many fabrics on all threads of the current pool, and returns a summary of each in their order.
///
/// Sheets are read and fits are made one at a time on each thread, and both are gone once they are summarised:
/// memory does not grow with the number of sheets, but by the summaries. A sheet that cannot be read or
/// identified is summarised as that error and stops nothing. `summarise` is called as each fabric is done, in
/// whatever order that is, so it may move a progress bar too; what it returns is the same for any number of
/// threads.
pub fn identify_all<I: Sync, E: From<Error>, T: Send>(
    inputs: &[I],
    settings: &Settings,
    read: impl Fn(&I) -> Result<Sheet, E> + Sync,
    summarise: impl Fn(&I, Result<(&Sheet, &Fit), E>) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let summaries = Mutex::new(Vec::with_capacity(inputs.len()));
    // Each thread takes the next sheet when it has done one. As one loop on each thread, not as many small tasks:
    // a thread that waits for the curves of its sheet would begin with another sheet, and hold both.
    rayon::broadcast(|_| {
        while let Some((index, input)) = {
            let index = next.fetch_add(1, Ordering::Relaxed);
            inputs.get(index).map(|input| (index, input))
        } {
            let summary = match read(input) {
                Ok(sheet) => match identify_with(&sheet, settings) {
                    Ok(fit) => summarise(input, Ok((&sheet, &fit))),
                    Err(error) => summarise(input, Err(error.into())),
                },
                Err(error) => summarise(input, Err(error)),
            };
            // A summary that panics takes its thread along, not the list.
            summaries.lock().unwrap_or_else(PoisonError::into_inner).push((index, summary));
        }
    });
    let mut summaries = summaries.into_inner().unwrap_or_else(PoisonError::into_inner);
    summaries.sort_by_key(|(index, _)| *index);
    summaries.into_iter().map(|(_, summary)| summary).collect()
}

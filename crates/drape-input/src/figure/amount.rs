//! Amounts of time and of memory in a unit that suits their size.

/// Returns a duration in `seconds` in seconds, minutes or hours.
///
/// ```
/// use drape_input::duration_in_words;
///
/// assert_eq!([0.25, 75.0, 600.0, 9000.0].map(duration_in_words), ["0.2 s", "75 s", "10 min", "2.5 h"]);
/// ```
#[must_use]
pub fn duration_in_words(seconds: f64) -> String {
    match seconds {
        ..10.0 => format!("{seconds:.1} s"),
        10.0..120.0 => format!("{seconds:.0} s"),
        120.0..7200.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}

/// Returns a size in `bytes` in kB, MB or GB, which are powers of 1000.
///
/// ```
/// use drape_input::size_in_words;
///
/// assert_eq!([999, 2_500_000, 3_200_000_000].map(size_in_words), ["1 kB", "2 MB", "3.2 GB"]);
/// ```
#[must_use]
pub fn size_in_words(bytes: u64) -> String {
    let bytes = bytes as f64;
    match bytes {
        ..1e6 => format!("{:.0} kB", (1e-3 * bytes).ceil()),
        ..1e9 => format!("{:.0} MB", 1e-6 * bytes),
        _ => format!("{:.1} GB", 1e-9 * bytes),
    }
}

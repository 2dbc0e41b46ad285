//! Signals that ask the program to end.
//!
//! The first signal ends a run at its next step, or cancels the current step if that step takes
//! long. A later signal ends the program at once. A signal that is ignored when the program starts,
//! as under `nohup` or behind `&` in a script, stays ignored.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, LazyLock, Once, OnceLock, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::Signal;
use signal_hook::iterator::Signals;

/// Signals that ask the program to end. They come from the keyboard, from another program, from a
/// terminal that closes, at the limit of the processor time, and from the scheduler of a cluster.
const WATCHED: [Signal; 5] = [Signal::INT, Signal::TERM, Signal::HUP, Signal::XCPU, Signal::USR1];

/// Signals within this time of the first one count as one signal, because shells and wrappers send
/// a signal to a process and to its group.
const DUPLICATE_WINDOW: Duration = Duration::from_millis(500);

/// Time that the current step has after the first signal. Then the step is cancelled.
const PATIENCE: Duration = Duration::from_millis(700);

/// Time of the first signal.
static FIRST_SIGNAL_TIME: OnceLock<Instant> = OnceLock::new();

/// Flag that cancels the current step.
static CANCEL_STEP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Number of the first signal, or 0 if none was received.
static RECEIVED: AtomicU8 = AtomicU8::new(0);

static WATCH: Once = Once::new();

/// Ignores `SIGXFSZ`, so that writing beyond the file size limit fails like writing to a full disk
/// instead of ending the program.
pub(crate) fn let_large_files_fail() {
    // If the signal cannot be registered, it still ends the program.
    let _ = signal_hook::flag::register(Signal::XFSZ.as_raw(), Arc::new(AtomicBool::new(false)));
}

/// Starts to record signals instead of ending at once. If signals cannot be watched, they still end
/// the program.
pub(crate) fn watch() {
    WATCH.call_once(|| {
        let (sender, receiver) = mpsc::channel();

        // A thread waits for signals, because a handler may do little more than set a flag. The
        // thread registers the signals itself: without a thread they must end the program.
        let watcher = thread::Builder::new().spawn(move || {
            let ignored = ignored_signals();
            let watched = WATCHED.map(Signal::as_raw).into_iter();
            let watched = watched.filter(|number| ignored & (1 << (number - 1)) == 0);
            let Ok(mut signals) = Signals::new(watched) else { return };
            let _ = sender.send(());
            let mut first_time = None;
            for signal in signals.forever() {
                record(signal, *first_time.get_or_insert_with(Instant::now));
            }
        });
        if watcher.is_ok() {
            // An error means that no signal was registered.
            let _ = receiver.recv();
        }
    });
}

/// Returns the signals that the program ignores as a mask, whose lowest bit is the signal with the
/// number 1. Linux alone reports the mask. It is 0 on other systems.
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Records a `signal`, where the first signal came at `first_time`. A signal that the user sent
/// after the first one ends the program.
fn record(signal: i32, first_time: Instant) {
    if RECEIVED.load(Ordering::Relaxed) != 0 {
        if first_time.elapsed() > DUPLICATE_WINDOW {
            std::process::exit(128 + signal);
        }
        return;
    }
    RECEIVED.store(u8::try_from(signal).unwrap_or_default(), Ordering::Relaxed);
    let _ = FIRST_SIGNAL_TIME.set(Instant::now());

    // A machine without memory for a thread cannot wait: the step is cancelled at once.
    let patience = thread::Builder::new().spawn(|| {
        thread::sleep(PATIENCE);
        CANCEL_STEP.store(true, Ordering::Relaxed);
    });
    if patience.is_err() {
        CANCEL_STEP.store(true, Ordering::Relaxed);
    }
}

/// Returns the number of the first signal, or `None` before it.
pub(crate) fn received() -> Option<u8> {
    Some(RECEIVED.load(Ordering::Relaxed)).filter(|signal| *signal > 0)
}

/// Returns the time since the first signal, or `None` before it.
pub(crate) fn time_since_first() -> Option<Duration> {
    FIRST_SIGNAL_TIME.get().map(Instant::elapsed)
}

/// Returns the flag that becomes `true` when the current step is to be cancelled, [`PATIENCE`]
/// after the first signal.
pub(crate) fn cancel_step_flag() -> Arc<AtomicBool> {
    CANCEL_STEP.clone()
}

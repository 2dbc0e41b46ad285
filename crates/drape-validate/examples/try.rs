//! Prints the checks of some cases.
use drape_validate::{Check, ValidationError, dynamics, statics};
fn main() {
    let only = std::env::args().nth(1);
    let cases: [(&str, fn() -> Result<Vec<Check>, ValidationError>); 9] = [
        ("heavy", statics::heavy_cantilever),
        ("end", statics::end_loaded_cantilever),
        ("catenary", statics::catenary),
        ("stretch", statics::self_stretch),
        ("column", statics::column),
        ("chain", dynamics::hanging_chain),
        ("strip", dynamics::hanging_strip),
        ("pendulum", dynamics::pendulum),
        ("fall", dynamics::free_fall),
    ];
    for (name, case) in cases {
        if only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        let start = std::time::Instant::now();
        match case() {
            Ok(checks) => {
                for c in checks {
                    println!(
                        "{name}: {} {:.6} ref {:.6} error {:.3e} limit {} {}",
                        c.what,
                        c.measured,
                        c.reference,
                        c.error(),
                        c.limit,
                        c.passes()
                    );
                }
            }
            Err(e) => println!("{name}: {e}"),
        }
        println!("   {:.2} s", start.elapsed().as_secs_f64());
    }
}

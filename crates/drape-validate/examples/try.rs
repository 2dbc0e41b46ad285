fn main() {
    for cells in [10, 20, 40] {
        for weight in [1.0, 10.0, 100.0] {
            let exact = drape_validate::reference::cantilever(weight, 0.0);
            let start = std::time::Instant::now();
            match drape_validate::statics::cantilever(weight, cells) {
                Ok([drop, reach]) => println!("{cells} {weight}: {:.5} vs {:.5}, error {:.3} %  drop {drop:.5} {:.5} {:.2} s", drop / reach, exact.drop / exact.reach, 100.0 * (drop / reach / (exact.drop / exact.reach) - 1.0), exact.drop, start.elapsed().as_secs_f64()),
                Err(e) => println!("{cells} {weight}: {e}"),
            }
        }
    }
}

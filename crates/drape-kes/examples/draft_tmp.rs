fn main() {
    for path in std::env::args().skip(1) {
        let path = std::path::PathBuf::from(path);
        let text = std::env::var("TEXT").is_ok();
        if text {
            let beside = path.parent().unwrap().to_owned();
            match drape_kes::SheetDraft::of(&path, &beside) {
                Ok(d) => d.iter().for_each(|d| println!("{}", d.text)),
                Err(e) => println!("ERROR {e}"),
            }
            continue;
        }
        println!("=== {}", path.display());
        let beside = if path.is_dir() { path.clone() } else { path.parent().unwrap().to_owned() };
        match drape_kes::SheetDraft::of(&path, &beside) {
            Ok(drafts) => {
                for draft in drafts {
                    println!("{}", draft.text);
                    draft.notes.iter().for_each(|n| println!("NOTE {n}"));
                    match draft.read(&beside) {
                        Ok(s) => println!(
                            "READ W {:?} warp {:?}\n weft {:?} T0 {:?} TM {:?} LC {:?} WC {:?} RC {:?} scatter {} curves {}",
                            s.w,
                            s.warp,
                            s.weft,
                            s.t0,
                            s.tm,
                            s.lc,
                            s.wc,
                            s.rc,
                            s.scatter.len(),
                            s.curves.len()
                        ),
                        Err(e) => println!("REFUSED {e}"),
                    }
                }
            }
            Err(e) => println!("ERROR {e}"),
        }
    }
}

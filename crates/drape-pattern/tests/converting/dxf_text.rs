//! Texts of DXF.

/// A block of DXF.
pub fn block(name: &str, body: &str) -> String {
    format!("0\nBLOCK\n8\n1\n2\n{name}\n70\n0\n10\n0.0\n20\n0.0\n{body}0\nENDBLK\n8\n1\n")
}

pub fn file(header: &str, blocks: &str, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n{header}0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
         {entities}0\nENDSEC\n0\nEOF\n"
    )
}

pub fn text(layer: u32, words: &str) -> String {
    format!("0\nTEXT\n8\n{layer}\n10\n0.0\n20\n0.0\n40\n1.0\n1\n{words}\n")
}

pub fn point(layer: u32, [x, y]: [f64; 2]) -> String {
    format!("0\nPOINT\n8\n{layer}\n10\n{x}\n20\n{y}\n")
}

pub fn line(layer: u32, a: [f64; 2], b: [f64; 2]) -> String {
    format!("0\nLINE\n8\n{layer}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", a[0], a[1], b[0], b[1])
}

pub fn polyline(layer: u32, points: &[[f64; 2]], closed: bool) -> String {
    let vertex = |p: &[f64; 2]| format!("0\nVERTEX\n8\n{layer}\n10\n{}\n20\n{}\n", p[0], p[1]);
    let all: String = points.iter().map(vertex).collect();
    format!(
        "0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n{}\n{all}0\nSEQEND\n8\n{layer}\n",
        u8::from(closed)
    )
}

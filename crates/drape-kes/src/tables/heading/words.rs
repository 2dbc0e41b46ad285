//! Words that tell the meaning of headings and titles of tables, in small letters, one line per
//! language: English, German, French, Italian, Spanish, Portuguese, Turkish, Japanese and Chinese.

use crate::test::{Direction, Test};

/// Words separated by commas, in several lines.
pub(crate) type Words = &'static [&'static str];

/// Returns the single words of the lines of `words`.
pub(crate) fn single(words: Words) -> impl Iterator<Item = &'static str> {
    words.iter().flat_map(|line| line.split(", "))
}

/// Kind of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Strain,
    /// Extension of the specimen, zero at the start.
    Extension,
    /// Position of the moving clamp, whose zero is arbitrary.
    Position,
    /// Distance of the clamps, the gauge length at the start.
    Distance,
    Angle,
    Curvature,
    Force,
    Moment,
    Cycle,
    Specimen,
    /// A known quantity that is neither deformation nor load: time, width, stress, temperature.
    Other,
}

/// Words of headings. The first entry with a matching word decides, so that "cycle time" is a time,
/// and "bending moment" a moment.
pub(super) const WORDS: [(Kind, Words); 11] = [
    (
        Kind::Other,
        &[
            "time, stress, temperature, width, thickness, speed, energy, work, modulus, area, index",
            "remark, note, specimen length, date, point, humidity, voltage, strain rate",
            "zeit, spannung, temperatur, breite, dicke, geschwindigkeit, bemerkung, arbeit, energie",
            "temps, contrainte, largeur, épaisseur, vitesse, énergie, travail",
            "tiempo, tempo, esfuerzo, anchura, velocidad, tensão, largura, velocidade, trabalho",
            "larghezza, velocità, lavoro, spessore, espesor, espessura",
            "zaman, süre, gerilme, sıcaklık, genişlik, kalınlık, hız, enerji",
            "時間, 応力, 温度, 幅, 厚, 速度, 仕事, 備考, エネルギー",
            "时间, 应力, 温度, 宽度, 厚度, 速度, 能量, 备注, 湿度",
        ],
    ),
    (Kind::Cycle, &["cycle, zyklus, zyklen, ciclo, çevrim, サイクル, 回数, 循环, loop no"]),
    (
        Kind::Distance,
        &[
            "distance, grip separation, jaw separation, einspannlänge, abstand, çene mesafesi",
            "つかみ間, チャック間, 夹距",
        ],
    ),
    (
        Kind::Strain,
        &[
            "strain, elongation (%), nominal strain, dehnung, déformation, deformation",
            "deformazione, deformación, deformação, gerinim, birim uzama, şekil değiştirme",
            "ひずみ, 歪, 伸び率, 伸長率, 伸度, 应变, 伸长率, 伸长度",
        ],
    ),
    (
        Kind::Angle,
        &["angle, winkel, angolo, ángulo, ângulo, açı, せん断角, 角度, ずり角, 剪切角, φ, phi"],
    ),
    (Kind::Curvature, &["curvature, krümmung, courbure, curvatura, eğrilik, 曲率"]),
    (
        Kind::Moment,
        &[
            "moment, momento, drehmoment, torque, tork, モーメント, 曲げ m, トルク, 弯矩, 力矩, 扭矩",
        ],
    ),
    (
        Kind::Force,
        &[
            "force, load, tension, kraft, last, charge, forza, carico, fuerza, carga, força",
            "kuvvet, yük, 荷重, 力, 張力, 载荷, 负荷, 负载",
        ],
    ),
    (
        Kind::Extension,
        &[
            "extension, elongation, displacement, extensometer, travel, standard travel",
            "verlängerung, standardweg, weg, längenänderung, verfahrweg",
            "allongement, déplacement, allungamento, spostamento, elongación, alargamiento",
            "desplazamiento, alongamento, extensão, deslocamento, uzama, deplasman, yer değiştirme",
            "伸び, 伸長, 変位, 伸长, 位移, 变形",
        ],
    ),
    (
        Kind::Position,
        &[
            "position, crosshead, traverse, traverso, stroke, hub, kolbenweg, posição, posición",
            "konum, ストローク, クロスヘッド, 横梁, 行程",
        ],
    ),
    (
        Kind::Specimen,
        &[
            "specimen, sample, test, repeat, replicate, run, probe, prüfling, versuch, prüfung",
            "échantillon, éprouvette, essai, provino, probeta, corpo de prova, numune, deney",
            "試料, 試験片, サンプル, 试样, 样品",
        ],
    ),
];

/// Symbols of a column.
pub(super) const SYMBOLS: [(Kind, &[&str]); 5] = [
    (Kind::Strain, &["e", "ε", "eps"]),
    (Kind::Force, &["f", "p", "fs", "ft"]),
    (Kind::Curvature, &["k", "κ"]),
    (Kind::Moment, &["m"]),
    (Kind::Angle, &["φ", "γ", "θ"]),
];

/// German words that end compound words: Standardkraft, Prüfzeit, Schubwinkel.
pub(super) const JOINED: [&str; 10] = [
    "kraft", "weg", "zeit", "winkel", "dehnung", "spannung", "abstand", "moment", "breite", "dicke",
];

/// Words of the two directions, in titles, names of sheets and headings.
pub(super) const DIRECTIONS: [(Direction, Words); 2] = [
    (
        Direction::Warp,
        &[
            "warp, wale, lengthwise, machine direction, md, kette, kettrichtung, kett",
            "chaîne, chaine, ordito, urdimbre, urdume, teia, çözgü, cozgu, osnowa, основа",
            "たて, タテ, 経, 縦, tate, 经, 縱",
        ],
    ),
    (
        Direction::Weft,
        &[
            "weft, filling, fill, woof, course, widthwise, crosswise, cross direction, cd",
            "schuss, schuß, schussrichtung, trame, trama, atkı, atki, wątek, уток",
            "よこ, ヨコ, 緯, 横, yoko, 纬",
        ],
    ),
];

/// Words for the time of a point.
pub(crate) const TIMES: Words =
    &["time, zeit, prüfzeit, temps, tiempo, tempo, zaman, süre", "時間, 経過時間, 时间"];

/// Words for a strip that is cut at 45° to the yarns, besides the angle.
pub(crate) const BIAS: Words = &[
    "bias, biais, sbieco, al bies, sesgo, viés, verev, schräg, diagonal, diagonale, diagonalrichtung",
    "バイアス, 斜め, 斜向, 斜裁, 正斜",
];

/// Words of the tests, in titles and names of sheets.
pub(super) const TESTS: [(Test, Words); 3] = [
    (
        Test::Tensile,
        &[
            "tensile, tension, fb1 tensile, traction, tens, extensibility, zug, zugversuch",
            "trazione, tracción, tração, çekme, 引張, 引っ張り, 拉伸",
        ],
    ),
    (
        Test::Shear,
        &[
            "shear, schub, scher, cisaillement, taglio, cizalla, cisalhamento, kayma, kesme",
            "せん断, 剪断, 剪切",
        ],
    ),
    (
        Test::Bending,
        &[
            "bending, pure bending, fb2, bend, biege, biegung, flexion, flessione, flexión",
            "flexão, eğilme, 曲げ, 弯曲",
        ],
    ),
];

/// Words for a part of one history.
pub(super) const PARTS: Words = &[
    "cycle, loading, unloading, recovery, return, zyklus, belastung, entlastung, hin, rück",
    "retour, aller, サイクル, 往, 復, 回復, 戻り",
];

/// Words for one of several specimens, besides its number.
pub(super) const SPECIMENS: Words = &[
    "specimen, sample, test, repeat, replicate, run, n, no, probe, prüfling, versuch, nr",
    "échantillon, éprouvette, essai, provino, probeta, numune, 試料, 試験片, サンプル, 试样",
];

/// Further words of tables of results, which tell the encoding of a file.
pub(super) const NAMES: Words = &[
    "biegesteifigkeit, flächengewicht, flächenmasse, prüfbericht, größe, maß, mäßig, für",
    "propriété, rigidité, résilience, unité, échantillon, moyenne, écart-type, linéarité, énergie",
    "propiedad, rigidez, flexión, tracción, cizallamiento, fricción, resiliência, atrito, compressão",
    "özellik, birim, ağırlık, gramaj, rijitlik, rijitliği, kayma, sıkıştırma, sürtünme, ortalama, yön",
    "項目, 単位, 平均, 標準偏差, 曲げ剛性, せん断剛性, 引張, 圧縮, 表面, 厚さ, 目付, 方向, 試験, 測定",
    "項目, 單位, 標準差, 彎曲剛度, 剪切剛度, 拉伸, 壓縮, 表面, 厚度, 克重, 經向, 緯向, 方向, 樣品",
    "项目, 单位, 平均值, 标准差, 弯曲刚度, 剪切刚度, 拉伸, 压缩, 表面, 厚度, 克重, 经向, 纬向, 样品, 测试",
];

//! Tables as laboratories of many countries write them: languages, encodings, decimal signs, units,
//! orientations, footers, specimens. Each is read right, or answered with the reason.

use drape_kes::SheetDraft;

#[path = "support/drafted.rs"]
mod support;

use support::{BOTH, WARP, WEFT, assert_values, drafted, get};

#[test]
fn a_german_report_in_windows_1252_with_titles_gaps_and_a_footer() {
    let text = "Prüfbericht Nr. 4711;;;;;\r\nAuftraggeber;Müller & Söhne;;;;\r\nPrüfdatum;12.03.2024;;;;\r\n\r\n\
        Prüfung;Kennwert;Einheit;Kette;Schuss;Bemerkung\r\n\
        Biegung;Biegesteifigkeit B;cN·cm²/cm;0,112;0,061;\r\n\
        Biegung;Hysterese der Biegung 2HB;cN·cm/cm;0,045;0,030;\r\n;;;;;\r\n\
        Scherung;Schersteifigkeit G;cN/(cm·°);0,75;0,73;Mittel aus 5\r\n\
        Scherung;Scherhysterese bei 0,5° 2HG;cN/cm;1,0;1,1;\r\n\
        Scherung;Scherhysterese bei 5° 2HG5;cN/cm;2,2;2,1;\r\n;;;;;\r\n\
        Zug;Zuglinearität LT;-;0,62;0,58;\r\nZug;Maximale Dehnung EMT;%;4,1;7,9;\r\n\r\n\
        Flächengewicht;;g/m²;213;;nach DIN EN 12127\r\nDicke;;mm;0,61;;\r\n\
        Luftdurchlässigkeit;;mm/s;120;;\r\nGeprüft von: Schmidt\r\n";
    let bytes = encoding_rs::WINDOWS_1252.encode(text).0.into_owned();
    // 1 cN is 1.019716 gf.
    let gf = 1.0 / 0.980_665;
    let draft = assert_values(
        "bericht.csv",
        &bytes,
        &[
            ("B", WARP, 0.112 * gf),
            ("2HB", WEFT, 0.030 * gf),
            ("G", WARP, 0.75 * gf),
            ("2HG", WEFT, 1.1 * gf),
            ("2HG5", WARP, 2.2 * gf),
            ("LT", WEFT, 0.58),
            ("EM", WARP, 4.1),
            ("W", None, 21.3),
            ("T", None, 0.61),
        ],
    );
    assert!(
        draft.notes.iter().any(|note| note.contains("\"Luftdurchlässigkeit\" (line 18)")),
        "{:?}",
        draft.notes
    );
}

#[test]
fn a_japanese_table_in_shift_jis_with_specimens_below_each_other() {
    let text = "ＫＥＳ測定結果\n試料名,綿ブロード\n\n\
        試料,曲げ剛性B(gf・cm2/cm),,曲げヒステリシス2HB(gf・cm/cm),,厚さT0(mm),目付W(mg/cm2)\n\
        ,たて,よこ,たて,よこ,,\n１,0.110,0.060,0.044,0.029,0.60,21.2\n２,0.112,0.061,0.045,0.030,0.61,21.3\n\
        ３,0.114,0.062,0.046,0.031,0.62,21.4\n平均,0.112,0.061,0.045,0.030,0.61,21.3\n\
        標準偏差,0.002,0.001,0.001,0.001,0.01,0.1\n変動係数(%),1.8,1.6,2.2,3.3,1.6,0.5\n";
    let bytes = encoding_rs::SHIFT_JIS.encode(text).0.into_owned();
    let draft = assert_values(
        "kes.csv",
        &bytes,
        &[&BOTH[..4], &[("T0", None, 0.61), ("W", None, 21.3)]].concat(),
    );
    assert_eq!(draft.name, "綿ブロード");
    let (draft, sheet) = drafted("kes.csv", &bytes);
    assert_eq!(get(&draft, &sheet, "B", WARP).1, 0.002);
    assert_eq!(get(&draft, &sheet, "W", None).1, 0.1);
    let wide = "縦/横,試験片,曲げ剛性,せん断剛性\n縦,1,0.110,0.74\n縦,2,0.114,0.76\n横,1,0.060,0.72\n横,2,0.062,0.74\n\
        目付,21.3 mg/cm2\n厚さ,0.61 mm\n";
    let bytes = encoding_rs::SHIFT_JIS.encode(wide).0.into_owned();
    assert_values(
        "縦横.csv",
        &bytes,
        &[BOTH[0], BOTH[1], BOTH[4], BOTH[5], ("W", None, 21.3), ("T", None, 0.61)],
    );
}

#[test]
fn french_chinese_turkish_and_portuguese_tables_in_their_encodings() {
    let french = "Propriété;Unité;Sens chaîne;Sens trame\n\
        Rigidité de flexion (B);gf.cm²/cm;0,112 ± 0,003;0,061 ± 0,002\n\
        Hystérésis de flexion (2HB);gf.cm/cm;0,045 ± 0,001;0,030 ± 0,001\n\
        Rigidité de cisaillement (G);gf/cm.deg;0,75 ± 0,02;0,73 ± 0,02\n\
        Masse surfacique;g/m²;213 ± 3;\nÉpaisseur à 0,5 gf/cm²;mm;0,61 ± 0,01;\n";
    let chinese = "织物力学性能测试结果\n面料,纯棉府绸\n指标,单位,经向,纬向\n弯曲刚度B,gf.cm2/cm,0.112,0.061\n\
        弯曲滞后矩2HB,gf.cm/cm,0.045,0.030\n剪切刚度G,gf/(cm.deg),0.75,0.73\n克重,g/m2,213,\n表观厚度,mm,0.61,\n";
    let turkish = "Özellik;Birim;Çözgü;Atkı\nEğilme rijitliği;gf.cm²/cm;0,112;0,061\n\
        Eğilme histerezisi;gf.cm/cm;0,045;0,030\nKayma rijitliği;gf/cm.derece;0,75;0,73\nGramaj;gr/m²;213;\n\
        Kalınlık T0;mm;0,61;\n";
    let portuguese = "Propriedade\tUnidade\tUrdume\tTrama\nRigidez à flexão (B)\tgf·cm²/cm\t0,112\t0,061\n\
        Histerese de flexão (2HB)\tgf·cm/cm\t0,045\t0,030\nRigidez ao cisalhamento (G)\tgf/cm·graus\t0,75\t0,73\n\
        Gramatura\tg/m²\t213\t\nEspessura T0\tmm\t0,61\t\n";
    let utf_16 = |text: &str| -> Vec<u8> {
        format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect()
    };
    let files = [
        ("français.csv", encoding_rs::WINDOWS_1252.encode(french).0.into_owned()),
        ("gb.csv", encoding_rs::GBK.encode(chinese).0.into_owned()),
        ("türkçe.csv", encoding_rs::WINDOWS_1254.encode(turkish).0.into_owned()),
        ("portugues.txt", utf_16(portuguese)),
    ];
    let wanted = [&BOTH[..], &[("W", None, 21.3), ("T0", None, 0.61)]].concat();
    for (file, bytes) in files {
        assert_values(file, &bytes, &wanted);
    }
    let (draft, sheet) = drafted("français.csv", &encoding_rs::WINDOWS_1252.encode(french).0);
    assert_eq!(get(&draft, &sheet, "B", WEFT).1, 0.002);
    assert_eq!(get(&draft, &sheet, "W", None).1, 3.0);
}

#[test]
fn numbers_with_units_and_groups_of_thousands_in_the_cells() {
    let points = "Property,Warp,Weft\nBending rigidity,\"11.2 uN.m\",\"6.1 uN.m\"\nShear stiffness,\"42.1 N/m\",\"41.0 N/m\"\n\
        WT,\"9,611.2 mJ/m2\",\"13,926 mJ/m2\"\nMass per area,\"213 g/m2\",\nThickness,610 um,\n";
    let mj = 1e-3 / 0.980_665;
    assert_values(
        "units.csv",
        points.as_bytes(),
        &[
            ("WT", WARP, 9611.2 * mj),
            ("WT", WEFT, 13926.0 * mj),
            ("B", WARP, 0.114_208),
            ("W", None, 21.3),
        ],
    );
    let commas = "Paramètre;Unité;Chaîne 1;Chaîne 2;Moyenne;Écart-type\nB;cN.cm²/cm;0,110;0,114;0,112;0,0028\n\
        WT;mJ/m²;9 611,2;9 700,0;9 655,6;62,8\n";
    let (draft, sheet) = drafted("thousands.csv", commas.as_bytes());
    let (wt, deviation) = get(&draft, &sheet, "WT", WARP);
    assert!((wt / (9655.6 * mj) - 1.0).abs() < 1e-6, "{wt}");
    assert!((deviation - 62.79).abs() < 0.01, "{deviation}");
    let keys = "Fabric: cotton poplin\nW: 12,4 mg/cm2\nT0: 0,31 mm\nB warp: 0,112 gf.cm2/cm\nB weft: 0,061\nG = 0,75 gf/(cm.deg)\n";
    let draft =
        assert_values("keys.txt", keys.as_bytes(), &[("W", None, 12.4), BOTH[0], BOTH[1], BOTH[4]]);
    assert_eq!(draft.name, "cotton poplin");
}

#[test]
fn deviations_stand_in_cells_columns_and_rows_of_their_own() {
    let files = [
        "Item,Warp,± SD,Weft,± SD\nB,0.112,0.004,0.061,0.002\n",
        "Item,Warp,SD,Weft,SD,n\nB,0.112,0.004,0.061,0.002,5\n",
        "B,warp,0.112,± 0.004\nB,weft,0.061,± 0.002\n",
        "Item,n,Mean,SE\nB warp,4,0.112,0.002\nB weft,4,0.061,0.001\n",
        "Item,n,Mean,SD,Min,Max\nB warp,5,0.112,0.004,0.108,0.118\nB weft,5,0.061,0.002,0.058,0.065\n",
        "Direction,B\nWarp,0.112\nWarp SD,0.004\nWeft,0.061\nWeft SD,0.002\n",
        "Item,Warp Mean (CV %),Weft Mean (CV %)\nB,0.112 (3.5714),0.061 (3.27869)\n",
        "Bending rigidity B (gf.cm2/cm)\n,1,2,3,Mean\nWarp,0.108,0.112,0.116,0.112\nWeft,0.059,0.061,0.063,0.061\n",
    ];
    for text in files {
        let (draft, sheet) = drafted("b.csv", text.as_bytes());
        for (direction, value, wanted) in [(WARP, 0.112, 0.004), (WEFT, 0.061, 0.002)] {
            let (found, deviation) = get(&draft, &sheet, "B", direction);
            assert!((found - value).abs() < 1e-9, "{text}\n{}", draft.text);
            assert!((deviation / wanted - 1.0).abs() < 1e-3, "{text}\n{}", draft.text);
        }
    }
    // Forward and backward are two senses of one specimen, and no two specimens.
    let senses = "Item,+,-,Mean\nB warp,0.113,0.111,0.112\nB weft,0.062,0.060,0.061\n";
    let (draft, sheet) = drafted("senses.csv", senses.as_bytes());
    assert_eq!(get(&draft, &sheet, "B", WARP), (0.112, 0.0), "{}", draft.text);
}

#[test]
fn tables_in_long_form_and_with_names_that_look_like_symbols() {
    let long = "fabric,test,parameter,direction,replicate,value,unit\n\
        A,bending,B,warp,1,0.110,gf.cm2/cm\nA,bending,B,warp,2,0.114,gf.cm2/cm\nA,bending,B,weft,1,0.060,gf.cm2/cm\n\
        A,bending,B,weft,2,0.062,gf.cm2/cm\nA,weight,W,,1,21.2,mg/cm2\nA,weight,W,,2,21.4,mg/cm2\n";
    assert_values("long.csv", long.as_bytes(), &[BOTH[0], BOTH[1], ("W", None, 21.3)]);
    // Specimens A, B and C: the second one is no bending rigidity.
    let letters = "Item,Unit,A,B,C,Average\nB warp,gf.cm2/cm,0.110,0.112,0.114,0.112\nW,mg/cm2,21.2,21.3,21.4,21.3\n";
    let (draft, sheet) = drafted("letters.csv", letters.as_bytes());
    assert_eq!(get(&draft, &sheet, "B", WARP), (0.112, 0.002), "{}", draft.text);
    // Fabrics B1 and G2, whose names are symbols with a suffix.
    let fabrics = "Fabric,W g/m2,T mm,B-warp,B-weft,G-warp,G-weft\nB1,150,0.35,0.08,0.05,0.6,0.55\nG2,210,0.42,0.12,0.10,0.8,0.7\n";
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fabrics.csv");
    std::fs::write(&path, fabrics).expect("written");
    let found = SheetDraft::sheet(&path, Some("G2")).expect("it is there");
    assert_eq!((found.warp.b, found.weft.g, found.t), (Some(0.12), Some(0.7), Some(0.42)));
}

#[test]
fn cantilevers_give_the_rigidity_of_their_bending_length() {
    let astm = "Stiffness of fabrics, ASTM D1388 Option A\nSample,Denim 12 oz\nMass per unit area,g/m2,407\n\
        Specimen,Direction,Overhang length (cm),Bending length (cm),Flexural rigidity (mg.cm)\n\
        1,Warp,6.2,3.1,1213\n2,Warp,6.4,3.2,1334\n3,Warp,6.0,3.0,1099\nAverage,Warp,6.2,3.1,1215\n\
        1,Weft,4.2,2.1,377\n2,Weft,4.4,2.2,433\n3,Weft,4.0,2.0,326\nAverage,Weft,4.2,2.1,379\n";
    // 1215.33 mg·cm by the force of a milligram, 9.80665e-6 N.
    let draft = assert_values(
        "denim.csv",
        astm.as_bytes(),
        &[("B", WARP, 1.215_333), ("B", WEFT, 0.378_667), ("W", None, 40.7)],
    );
    assert_eq!(draft.name, "Denim 12 oz");
    // By the constant of ASTM D1388 the rigidity is 1.45 times as large.
    let constant = "Property,Unit,Warp,Weft\nFabric weight,g/m2,150,\nBending length,mm,20,15\nFlexural rigidity G,uN.m,17.05,7.194\n";
    let peirce = |length: f64| 9.81e-6 * 150.0 * length.powi(3) / 98.0665;
    let draft = assert_values(
        "d1388.csv",
        constant.as_bytes(),
        &[("B", WARP, peirce(20.0)), ("B", WEFT, peirce(15.0))],
    );
    assert!(draft.notes[0].contains("by the constant of ASTM D1388"), "{:?}", draft.notes);
    // Of JIS L 1096 the angle is 45°: w·L³/B is 9.2539.
    let jis =
        "JIS L1096 A法 45°カンチレバー法\n項目,単位,たて,よこ\n剛軟度,mm,62,41\n目付,g/m2,150,\n";
    let steep = |overhang: f64| 9.81e-6 * 150.0 * overhang.powi(3) / 9.2539 / 98.0665;
    let bytes = encoding_rs::SHIFT_JIS.encode(jis).0.into_owned();
    assert_values("jis.csv", &bytes, &[("B", WARP, steep(62.0)), ("B", WEFT, steep(41.0))]);
    // Without a mass there is no rigidity, which is told where the values stand.
    let alone = "Item,Warp,Weft\nBending length (mm),20,15\nT (mm),0.4,\n";
    let (draft, sheet) = drafted("alone.csv", alone.as_bytes());
    assert_eq!(sheet.warp.b, None);
    assert!(draft.text.contains("# bending length 20 mm of the warp"), "{}", draft.text);
}

#[test]
fn values_of_fast_beside_those_of_kes_are_kept_as_comments_with_the_reason() {
    let text = "Parameter,Unit,Warp,Weft\nB,gf.cm2/cm,0.112,0.061\n2HB,gf.cm/cm,0.045,0.030\nEM,%,4.1,7.9\nLT,-,0.62,0.58\n\
        RT,%,58,55\nE5,%,0.4,0.7\nE20,%,1.1,1.9\nE100,%,3.2,4.1\nEB5,%,4.2,\nC,mm,17.5,15.1\nW,g/m2,213,\nT2,mm,0.41,\nT0,mm,0.61,\n";
    let draft = assert_values(
        "mixed.csv",
        text.as_bytes(),
        &[
            BOTH[0],
            BOTH[1],
            ("EM", WARP, 4.1),
            ("LT", WEFT, 0.58),
            ("T0", None, 0.61),
            ("W", None, 21.3),
        ],
    );
    let (_, sheet) = drafted("mixed.csv", text.as_bytes());
    let stiffness = sheet.warp.shear_stiffness().expect("by EB5");
    assert!((stiffness / (123.0 / 4.2) - 1.0).abs() < 1e-4, "{stiffness}");
    assert_eq!(sheet.fm, None, "the tensile test is that of KES");
    for words in ["# E5 = 0.4 %, E20 = 1.1 %, E100 = 3.2 %", "# thickness 0.41 mm at 2 gf/cm2"] {
        assert!(draft.text.contains(words), "{words} is missing in\n{}", draft.text);
    }
}

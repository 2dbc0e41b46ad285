//! Names of items, and the words beside them, in small letters, one line per language: English,
//! German, French, Italian, Spanish, Portuguese, Turkish, Japanese and Chinese.

use crate::results::item::Item;
use crate::tables::heading::words::Words;

/// Names of items. The longest name in a label decides.
pub(super) const ITEMS: [(Item, Words); 25] = [
    (
        Item::Key("B"),
        &[
            "bending rigidity, bending stiffness, flexural rigidity, flexural stiffness",
            "biegesteifigkeit, biegesteife, biegesteifheit",
            "rigidité de flexion, rigidité en flexion, rigidité à la flexion, raideur de flexion",
            "rigidità flessionale, rigidità a flessione, rigidità di flessione, rigidezza flessionale",
            "rigidez a la flexión, rigidez de flexión, rigidez flexural, rigidez flexional",
            "rigidez à flexão, rigidez de flexão, rigidez em flexão",
            "eğilme rijitliği, eğilme sertliği, eğilme direnci",
            "曲げ剛性, 曲げ剛さ, 曲げ硬さ, 曲げかたさ, 剛軟性",
            "弯曲刚度, 弯曲刚性, 抗弯刚度, 彎曲剛度, 彎曲剛性",
        ],
    ),
    (
        Item::Key("2HB"),
        &[
            "bending hysteresis, hysteresis of bending, hysteresis of bending moment",
            "bending moment hysteresis, biegehysterese, hysterese der biegung",
            "hystérésis de flexion, hystérésis en flexion, isteresi di flessione, isteresi a flessione",
            "histéresis de flexión, histerese de flexão, histerese à flexão, eğilme histerezisi",
            "曲げヒステリシス, 曲げヒステリシス幅, 弯曲滞后, 弯曲滞后矩, 弯曲滞后量, 彎曲滯後矩",
        ],
    ),
    (
        Item::Key("G"),
        &[
            "shear rigidity, shear stiffness, shearing stiffness, schersteifigkeit, schubsteifigkeit",
            "rigidité de cisaillement, rigidité au cisaillement, rigidité en cisaillement",
            "rigidità a taglio, rigidità di taglio, rigidez al cizallamiento, rigidez a cizalla",
            "rigidez a la cizalladura, rigidez ao cisalhamento, rigidez de cisalhamento",
            "kayma rijitliği, kesme rijitliği, kayma sertliği, makaslama rijitliği",
            "せん断剛性, 剪断剛性, せん断かたさ, せん断硬さ",
            "剪切刚度, 剪切刚性, 剪切剛度, 抗剪刚度",
        ],
    ),
    (
        Item::Key("2HG"),
        &[
            "shear hysteresis, hysteresis of shear, hysteresis of shear force",
            "scherhysterese, schubhysterese, hysterese der scherung, hysterese der schubkraft",
            "hystérésis de cisaillement, hystérésis en cisaillement, isteresi di taglio",
            "isteresi a taglio, histéresis de cizallamiento, histéresis de cizalla",
            "histerese de cisalhamento, histerese ao cisalhamento, kayma histerezisi, kesme histerezisi",
            "せん断ヒステリシス, 剪断ヒステリシス, 剪切滞后, 剪切滞后矩, 剪切滯後矩",
        ],
    ),
    (
        Item::Key("LT"),
        &[
            "tensile linearity, linearity of tensile, linearity of tension, linearity of load extension",
            "zuglinearität, linearität der zugkurve, linearität zug, linéarité de traction",
            "linéarité en traction, linearità a trazione, linearità di trazione, linealidad a tracción",
            "linealidad de tracción, linearidade de tração, linearidade à tração, çekme doğrusallığı",
            "çekme lineerliği, 引張線形性, 引張り線形性, 引張直線性, 引張りの直線性",
            "拉伸线性度, 拉伸线性, 拉伸線性度",
        ],
    ),
    (
        Item::Key("WT"),
        &[
            "tensile energy, tensile work, zugenergie, zugarbeit, énergie de traction",
            "travail de traction, energia di trazione, lavoro di trazione, energía de tracción",
            "trabajo de tracción, energia de tração, trabalho de tração, çekme enerjisi, çekme işi",
            "引張仕事量, 引張り仕事量, 引張エネルギー, 引張りエネルギー, 拉伸功, 拉伸能, 拉伸比功",
        ],
    ),
    (
        Item::Key("RT"),
        &[
            "tensile resilience, zugerholung, zugresilienz, zugelastizität, résilience de traction",
            "résilience en traction, résilience à la traction, resilienza a trazione",
            "resiliencia a la tracción, resiliencia de tracción, resiliência à tração",
            "resiliência de tração, çekme rezilyansı, çekme rezilansı",
            "引張レジリエンス, 引張りレジリエンス, 引張回復率, 引張回復性",
            "拉伸回弹性, 拉伸回复率, 拉伸回弹率, 拉伸弹性回复率, 拉伸功回复率",
        ],
    ),
    (
        Item::Key("EM"),
        &[
            "extensibility, maximum extension, extension at maximum load, elongation at maximum load",
            "maximum elongation, maximum tensile strain, maximale dehnung, dehnbarkeit, höchstdehnung",
            "extensibilité, allongement maximal, estensibilità, allungamento massimo, extensibilidad",
            "alargamiento máximo, extensibilidade, alongamento máximo, maksimum uzama, uzayabilirlik",
            "最大伸長率, 最大伸び率, 最大伸び, 伸長率, 伸び率, 伸長度, 最大伸长率, 伸长率",
        ],
    ),
    (
        Item::Key("LC"),
        &[
            "compression linearity, compressional linearity, linearity of compression",
            "kompressionslinearität, linearität der kompression, linearität kompression",
            "linéarité de compression, linéarité en compression, linearità a compressione",
            "linealidad a compresión, linealidad de compresión, linearidade de compressão",
            "linearidade à compressão, sıkıştırma doğrusallığı, sıkışma doğrusallığı",
            "圧縮線形性, 圧縮直線性, 圧縮の直線性, 压缩线性度, 压缩线性, 壓縮線性度",
        ],
    ),
    (
        Item::Key("WC"),
        &[
            "compression energy, compressional energy, compression work, work of compression",
            "kompressionsenergie, kompressionsarbeit, énergie de compression, travail de compression",
            "energia di compressione, energía de compresión, energia de compressão",
            "trabalho de compressão, sıkıştırma enerjisi, sıkıştırma işi, sıkışma enerjisi",
            "圧縮仕事量, 圧縮エネルギー, 压缩功, 压缩能, 压缩比功, 壓縮功",
        ],
    ),
    (
        Item::Key("RC"),
        &[
            "compression resilience, compressional resilience, kompressionserholung",
            "kompressionsresilienz, résilience de compression, résilience en compression",
            "résilience à la compression, resilienza a compressione, resiliencia a la compresión",
            "resiliencia de compresión, resiliência à compressão, resiliência de compressão",
            "sıkıştırma rezilyansı, sıkışma rezilyansı, 圧縮レジリエンス, 圧縮回復率, 圧縮回復性",
            "压缩回弹性, 压缩回复率, 压缩回弹率, 压缩功回复率, 壓縮回彈性",
        ],
    ),
    (
        Item::Key("MIU"),
        &[
            "coefficient of friction, friction coefficient, mean frictional coefficient",
            "frictional coefficient, reibungskoeffizient, reibungszahl, reibwert",
            "coefficient de frottement, coefficiente di attrito, coeficiente de fricción",
            "coeficiente de rozamiento, coeficiente de atrito, sürtünme katsayısı",
            "平均摩擦係数, 摩擦係数, 平均摩擦系数, 摩擦系数",
        ],
    ),
    (
        Item::Key("MMD"),
        &[
            "mean deviation of miu, deviation of friction, mean deviation of friction",
            "mean deviation of the coefficient of friction, mean deviation of frictional coefficient",
            "mittlere abweichung des reibungskoeffizienten, écart moyen du coefficient de frottement",
            "deviazione media del coefficiente di attrito, desviación media del coeficiente de fricción",
            "desvio médio do coeficiente de atrito, sürtünme katsayısının ortalama sapması",
            "摩擦係数の平均偏差, 摩擦係数の変動, 平均摩擦係数の変動, 摩擦係数の標準偏差",
            "摩擦系数平均偏差, 摩擦系数的平均偏差, 摩擦系数平均差不匀率",
        ],
    ),
    (
        Item::Key("SMD"),
        &[
            "surface roughness, geometrical roughness, geometric roughness, oberflächenrauheit",
            "oberflächenrauigkeit, oberflächenrauhigkeit, rauheit, rugosité, rugosità superficiale",
            "rugosità, rugosidad, rugosidade, yüzey pürüzlülüğü, 表面粗さ, 表面あらさ, 表面粗糙度",
        ],
    ),
    (
        Item::Key("W"),
        &[
            "weight, fabric weight, mass per area, mass per unit area, areal density, areal weight",
            "area weight, basis weight, area density, flächengewicht, flächenmasse, grammatur",
            "quadratmetergewicht, m2 gewicht, m² gewicht, gewicht, masse surfacique, grammage, poids",
            "massa areica, grammatura, peso, masa por área, masa laminar, gramaje",
            "gramatura, massa por área, gramaj, birim alan ağırlığı, metrekare ağırlığı, ağırlık",
            "目付, 目付け, 重量, 重さ, 単位面積質量, 単位面積当たりの質量, 質量, 面密度",
            "克重, 平方米质量, 平方米重量, 平方米重, 单位面积质量, 面密度, 单位面积重量, 基重",
        ],
    ),
    (
        Item::Key("T"),
        &[
            "thickness, dicke, gewebedicke, stoffdicke, épaisseur, spessore, espesor, grosor",
            "espessura, kalınlık, kumaş kalınlığı, 厚さ, 厚み, 厚度",
        ],
    ),
    (
        Item::Key("T0"),
        &["initial thickness, 初期厚さ, 表观厚度, 初始厚度, anfangsdicke, épaisseur initiale"],
    ),
    (Item::Key("TM"), &["minimum thickness, 最大圧縮時厚さ, 稳定厚度, 最小厚さ, mindestdicke"]),
    (
        Item::BendingLength,
        &[
            "bending length, biegelänge, longueur de flexion, lunghezza di flessione",
            "longitud de flexión, comprimento de flexão, eğilme uzunluğu",
            "曲げ長さ, 曲げ長, 弯曲长度, 抗弯长度, 彎曲長度",
        ],
    ),
    (
        Item::Overhang,
        &[
            "overhang length, length of overhang, overhang, overhanging length, überhanglänge",
            "überhang, longueur de porte à faux, porte à faux, longueur en porte à faux",
            "lunghezza a sbalzo, sporgenza, longitud de voladizo, longitud en voladizo",
            "comprimento suspenso, comprimento em balanço, sarkma uzunluğu, sarkan uzunluk",
            "はみ出し長さ, 押し出し長さ, 突出長さ, 剛軟度, 伸出长度, 滑出长度, 悬垂长度",
        ],
    ),
    (
        Item::BiasExtension,
        &["bias extension, bias extensibility, extensibilité en biais, バイアス伸び"],
    ),
    (
        Item::Extension(100),
        &[
            "extension at load, extension under load, extension, elongation, dehnung",
            "allongement, allungamento, alargamiento, alongamento, uzama, 伸び, 伸长",
        ],
    ),
    (Item::Unused("formability"), &["formability, formbarkeit, formabilité, 成形性, 成形性能"]),
    (
        Item::Unused("shrinkage or expansion"),
        &["relaxation shrinkage, hygral expansion, relaxationsschrumpf, 松弛收缩, 湿膨胀"],
    ),
    (
        Item::Unused("drape coefficient"),
        &[
            "drape coefficient, fallkoeffizient, coefficient de drapé, coefficiente di drappeggio",
            "coeficiente de drapeado, coeficiente de caimento, dökümlülük katsayısı, ドレープ係数",
            "悬垂系数",
        ],
    ),
];

/// Words for tests other than KES, FAST and cantilevers: until the break, or of a body that does
/// not slide yet.
pub(super) const OTHER_TESTS: Words = &[
    "break, breaking, rupture, at maximum force, tear, tearing, static, bruch, reiß, höchstzugkraft",
    "weiterreiß, haft, haftreibung, à la rupture, déchirure, statique, rottura, rotura, ruptura",
    "lacerazione, rasgado, estático, statico, kopma, yırtılma, statik",
    "破断, 切断, 引裂, 静摩擦, 断裂, 撕裂, 静态",
];

/// Words of a mean.
pub(super) const MEAN: Words = &[
    "mean, average, avg, ave, mean value, x̄, mittelwert, mittel, mw, durchschnitt, moyenne, moy",
    "media, valore medio, promedio, média, ortalama, ort, 平均, 平均値, 平均值, 均值",
];

/// Words of a standard deviation.
pub(super) const DEVIATION: Words = &[
    "sd, s d, std, stdev, std dev, st dev, standard deviation, stddev, σ, standardabweichung, stabw",
    "std abw, standardabw, écart type, deviazione standard, dev std, scarto tipo",
    "desviación estándar, desviación típica, desv est, desvio padrão, dp, standart sapma, ss",
    "標準偏差, 标准差, 标准偏差, 標準差",
];

/// Words of a coefficient of variation.
pub(super) const VARIATION: Words = &[
    "cv, cv%, c v, coefficient of variation, variation coefficient, variationskoeffizient, vk",
    "coefficient de variation, coefficiente di variazione, coeficiente de variación",
    "coeficiente de variação, varyasyon katsayısı, 変動係数, 变异系数, 變異係數",
];

/// Words of a standard error of a mean.
pub(super) const ERROR: Words =
    &["se, sem, s e, standard error, standardfehler, erreur standard, 標準誤差"];

/// Words of a number of specimens.
pub(super) const COUNT: Words = &[
    "n, count, number of specimens, number of tests, anzahl, nombre, numero prove, número de ensayos",
    "adet, 試験回数, 測定数, 次数, 样本数",
];

/// Words of other statistics, which have no use.
pub(super) const OTHER: Words = &[
    "min, max, minimum, maximum, median, range, variance, spannweite, étendue, ci, confidence",
    "confidence interval, vertrauensbereich, 最大, 最小, 最大値, 最小値, 最大值, 最小值, 中央値, 範囲",
];

/// Words of the face of a fabric, or of a deformation forward.
pub(super) const FACE: Words = &[
    "face, face side, right side, forward, face up, vorderseite, oberseite, rechte seite, hin",
    "endroit, recto, dritto, haz, derecho, cara, direito, ön yüz, ön, yüz, 表, 表側, 正面, 正向",
];

/// Words of the back of a fabric, or of a deformation backward.
pub(super) const BACK: Words = &[
    "back, back side, reverse, reverse side, wrong side, backward, face down, rückseite",
    "unterseite, linke seite, envers, verso, rovescio, envés, revés, avesso, arka yüz, arka, ters",
    "裏, 裏側, 反面, 背面, 反向",
];

/// Words of specimens of one fabric, at the head of their names or numbers.
pub(super) const SPECIMEN: Words = &[
    "specimen, specimens, specimen no, test piece, test, no, nr, repeat, replicate, run, #, number",
    "rep, prüfling, probekörper, probe, versuch, messung, éprouvette, essai, n°, provino, prova",
    "probeta, ensayo, corpo de prova, repetição, deney, tekrar, 試験片, 回数, 番号, 试样, 次",
];

/// Words of fabrics, at the head of their names.
pub(super) const FABRIC: Words = &[
    "fabric, fabric name, material, article, style, cloth, textile, code, id, name, stoff, gewebe",
    "artikel, material, bezeichnung, tissu, étoffe, article, tessuto, tela, tejido, artículo",
    "tecido, artigo, kumaş, malzeme, 生地, 布, 品番, 品名, 試料名, 織物, 织物, 面料, 编号, 品种",
];

/// Words for samples, which are fabrics in some laboratories and specimens in others.
pub(super) const SAMPLE: Words = &[
    "sample, samples, sample id, sample no, sample name, muster, échantillon, campione, muestra",
    "amostra, numune, 試料, サンプル, 样品",
];

/// Words for units, at the head of a column of units.
pub(super) const UNIT: Words = &[
    "unit, units, uom, einheit, einheiten, unité, unités, unità, unidad, unidades, unidade",
    "birim, 単位, 单位, 單位",
];

/// Words without meaning: heads of the columns of names, units and values, and names of tests.
pub(super) const GENERIC: Words = &[
    "parameter, parameters, property, properties, symbol, unit, units, value, values, result, results",
    "test, tests, item, items, data, table, kes, kes f, kesf, fb1, fb2, fb3, fb4, direction, dir",
    "measurement, measured, characteristic, quantity, description, tensile, shear, bending",
    "compression, surface, weight and thickness, construction, kawabata, fast, at, in, of, the, and",
    "side, wise, method, instrument, feature, mechanical properties",
    "einheit, einheiten, wert, werte, messwert, messwerte, kennwert, kenngröße, größe, ergebnis",
    "ergebnisse, eigenschaft, eigenschaften, prüfung, richtung, zug, scherung, schub, biegung",
    "kompression, oberfläche, in, bei, der, die, das, merkmal",
    "paramètre, paramètres, unité, unités, valeur, valeurs, résultat, résultats, propriété",
    "propriétés, sens, essai, traction, cisaillement, flexion, surface, en, de, du, la, le",
    "parametro, parametri, unità, valore, valori, risultato, risultati, proprietà, direzione, prova",
    "parámetro, unidad, valor, valores, resultado, resultados, propiedad, dirección, ensayo, sentido",
    "parâmetro, unidade, propriedade, direção, ensaio, tração, cisalhamento, flexão, compressão",
    "superfície, sentido, parametre, birim, değer, değerler, sonuç, sonuçlar, özellik, özellikler",
    "yön, yönü, yönünde, deney, test, çekme, kayma, eğilme, sıkıştırma, yüzey",
    "項目, 測定項目, 特性, 特性値, 単位, 値, 測定値, 結果, 記号, 方向, 試験, 引張, 引張り, せん断, 曲げ",
    "圧縮, 表面, 力学特性, 基本力学特性, 时, の",
    "项目, 测试项目, 指标, 性能, 性能指标, 单位, 數值, 数值, 值, 参数, 符号, 结果, 测试, 拉伸, 剪切",
    "弯曲, 压缩, 項目, 單位, 參數, 向",
];

//! Limits of the validation: what the model leaves out, and what of it is not tested.

/// Limits that the pages list at their end, in Markdown.
pub(crate) const LIMITS: &[&str] = &[
    "The model has no creep and no dependence on the rate: what the friction holds, it holds \
     for ever, and a slow cloth is as stiff as a quick one.",
    "Nothing in it depends on moisture or temperature; a sheet holds for the air it was \
     measured in.",
    "Warp and weft stay where they cross: they turn about their crossings in shear, but do not \
     slide along each other. Stretching one does not shorten the other (no exchange of crimp).",
    "Bending does not depend on tension, nor the fabric's friction on pressure. The fabric is \
     not compressed through its thickness, and does not tear.",
    "In these cases cloth meets bodies at its particles only, and does not meet itself.",
    "Air resists the motion of the cloth, and does not move by itself.",
    "The shear of the fabrics that ship was not published or not measured and is assumed, as \
     the curvature is over which bending friction builds up; every fit prints what it assumed.",
    "Cells that bend on the bias fold along their diagonals, and their corners there shear \
     although the cloth does not: the\n\
     moment is larger by a part Gκ²h⁴/16(B₁ + B₂). That closed form and the simulated specimens \
     are half a percent of the\n\
     loop apart. For the cupro bent to a radius of 2 cm it is a hundredth at 2.5 mm, a sixth at \
     5 mm and 2.7 times the moment\n\
     at 10 mm. A strip of 5 cm (16 µN·m, 200 g/m², G = 30 N/m) clamped level and cut at 45° \
     hung with a drop over reach of\n\
     2.57 at 3.4 mm, 1.96 at 6.7 mm and 1.06 at 13 mm, where the heavy elastica has 2.59; along \
     the yarns it was 1.51, 1.49\n\
     and 1.45 at 2.4, 4.8 and 9.1 mm, and should be 1.51. Folds on the bias ask for finer cells \
     than folds along the yarns.",
    "Yarns twist for nothing: a saddle along them stores no energy of bending, so a strip on \
     the bias has B = (B₁ + B₂)/4,\n\
     and a narrow one, whose edges may curl, less. What a fabric's yarns resist to twisting is \
     not in its KES sheet.",
    "What a bent specimen keeps is held against a slow release. Let go at once it springs, and \
     keeps 57 to 69 % of that. A\n\
     crease keeps a degree or few; fibres that yield and creep at the radius of a yarn are \
     beyond loops of 2.5 cm⁻¹.",
    "What an instrument's loop is held against is the law that was fitted, not the measured \
     curve: how well a law follows\n\
     a curve is the fit's report. At 10 and 5 mm a bending specimen of 1 cm is one or two \
     cells, all of them held; with free\n\
     cells between (2.5 mm) fabrics whose traction begins soft are 1.5 to 1.8 % off, because a \
     bow also pulls at its yarn\n\
     with the moment times the curvature, and such a yarn gives way.",
    "The drape coefficients of two fabrics have been compared, once each (`drapemeter-cotton`, \
     `drapemeter-wool`; ten\n\
     starts for each study). Matsudaira's wool drapes to 48.7 % where 49.8 was measured, in \
     five or six folds where\n\
     five were counted; his cotton to 84.8 % where 82.9 was measured, in five or six folds \
     where two were counted.\n\
     What their sheets leave open, which is shear and the building up of the bending friction, \
     moves the wool from\n\
     45.6 to 52.9 % and the cotton from 73.2 to 87.4 %; most of the cotton's range is the \
     friction's. Without\n\
     friction they drape to 40.4 and 62.3 %. At 0.7 of the spacing the wool is 1.6 points off, \
     the cotton 0.2\n\
     (`grid-wool`, `grid-cotton`). Turned on the disc they drape the same, for the grid lies \
     along the yarns and\n\
     turns with them. What else matters, and how far, is in `sensitivity-cotton` and \
     `sensitivity-wool` (four starts\n\
     at either end, particles at 5 mm). Without inertia the two keep 6 and 8 points more. The \
     speed of the measured\n\
     ones is not known, nor whether they were shaken.",
    "The specimens of the drapemeters begin uneven by up to 0.2 mm, smoothly over 20 mm. This \
     is the same at every\n\
     spacing, and it has to be: where each particle began at a height of its own, the cloth was \
     curved the more the\n\
     finer its grid, and its friction had slipped, it seems, before it moved. Then the cotton \
     draped to 85.2 % in\n\
     five or six folds at 4.7 mm (30 starts), to 82.2 % at 3.3 mm (13) and to 74.7 % in four or \
     five at 2.3 mm (7).\n\
     Smoothly uneven it drapes to 84.8 % at 4.7 mm, and to 82.6 % in five or six folds at 2.3 \
     mm (4). A rim of\n\
     triangles along the edge of the disc, in place of a ragged one, costs three to four times \
     as much and moves that\n\
     little (83.7 % at 4.7 mm, 6 starts). Half as uneven, five starts at 3.3 mm drape to 82.8 \
     %, and else to 84.1:\n\
     the number of folds is a near thing. How uneven a real specimen is, or how far its \
     friction has slipped before,\n\
     is not known.",
    "Breen's fabrics are not published. What stands for his stiff cotton has four times the \
     bending of Matsudaira's cotton broad, and what\n\
     stands for his polyester/cotton a quarter of it along the weft, by choice. That stiff \
     cloth has one billow at a corner, limp cloth\n\
     two and cloth with a limp weft slanted ones is so on grids of 2 and of 1 cm; how stiff his \
     cotton was is not known. Matsudaira's\n\
     cotton itself has two, as it would have were it twice as stiff. Breen's photographs are \
     compared in words only.",
    "Breen's particles count their distances in spacings: at 2 cm cloth keeps 2 cm from itself, \
     and neighbours across a cell repel each\n\
     other beyond 30° of shear, on any grid.",
    "The shapes that Tagawa and others photographed are not legible enough to compare.",
];

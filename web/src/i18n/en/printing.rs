//! Texts of targets to print.

use super::{English, choose};
use crate::i18n::declare;

declare! { printing {
    targets_to_print: "Targets to print";
    targets_to_print_words: "Coded rings, dots, scale bars and calibration fields on paper, true to scale, as PDF and SVG. Works offline.";
    sheets_sentence(codes, dots, bars, sheets):
        "{codes} ring {codes:code|codes}, {dots} plain {dots:dot|dots} and {bars} scale-bar {bars:pair|pairs} on {sheets} {sheets:sheet|sheets}.";
    nothing_yet: "No sheets yet.";
    save_svg: "Save SVG";
    save_pdf(sheets): "Save PDF, {sheets} {sheets:sheet|sheets}";
    save_lists: "Save diameters and distances";
    coded_targets: "Coded targets";
    family: "Family";
    schneider(bits): "Schneider / AICON, {bits} bit";
    metashape(bits): "Metashape circular, {bits} bit";
    how_many: "How many";
    numbers: "Or code numbers";
    numbers_hint: "e.g. 1-20, 35";
    family_has(all): "The family has {all} codes.";
    family_at_distance(count, distance): "{count} of them differ by at least {distance} sectors in every rotation";
    printed_distance(distance, hidden):
        "The codes on these sheets differ by at least {distance} sectors: with {hidden} {hidden:sector|sectors} misread or occluded, no code is read as another.";
    dot_diameter: "Dot diameter";
    ground: "Background";
    ground_paper: "white, black dots";
    ground_retro: "black, white dots (retro)";
    also_on_sheets: "Also on the sheets";
    plain_dots: "Plain dots";
    jittered: "Dots shifted from the grid at random";
    bar_pairs: "Scale-bar pairs";
    bar_length: "Distance of a pair";
    calibration_field: "Calibration field with its coordinates";
    field_sheets: "Sheets, across × down";
    cut_marks: "Cut marks";
    small_print: "Number and family in small print";
    paper: "Paper";
    sheet_title: "Title on the sheets";
    sheets: "Sheets";
    sheet_of(sheet, all): "Sheet {sheet} of {all}";
    previous_sheet: "Previous sheet";
    next_sheet: "Next sheet";
    preview: "Preview of the sheet";
    ruler_of_print: "Ruler check";
    one_is_enough: "one sheet is enough";
    ruler_across: "Measured length of the horizontal 100 mm ruler";
    ruler_down: "Measured length of the vertical 100 mm ruler";
    as_across: "as horizontal";
    reading_sigma: "σ of the reading";
    not_measured: "Print a sheet at 100 %, without fitting to the page, and measure its rulers. The measured lengths correct diameters, printed distances and nominal coordinates.";
    print_scale(across, down, sigma, diameter):
        "Print scale {across} across, {down} down, ± {sigma}: dots are {diameter} mm. Diameters, printed distances and nominal coordinates include it; measure bars mounted by hand on the bar itself.";
    which_diameter: "Choosing the diameter";
    camera_words(c, width, height): "c {c} px, {width} × {height} px";
    camera_assumed: "no camera in the project: 24 megapixels and 28 mm are assumed";
    col_distance: "distance";
    col_pixel: "pixel";
    col_least: "at least";
    col_best: "best";
    col_dot: "dot in the photo";
    straight_on: "0°";
    at_slant: "60°";
    advice_words: "A dot needs at least 8 px in diameter, preferably 15. At 60° it is half as wide.";
    too_small: "too small";
    just_so: "small at 60°";
    print_hint: "Print without \"fit to page\". The PDF has this setting.";
} }

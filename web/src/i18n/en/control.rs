//! Texts of control points, distances and their lists.

use super::{English, choose};
use crate::i18n::declare;

declare! { control {
    // Control and scale
    control_and_scale: "Control, scale";
    control_sentence(control, check, distances):
        "{control} {control:control point|control points}, {check} check {check:point|points}, {distances} {distances:distance|distances}.";
    open_control: "Open control points…";
    control_points: "Control points";
    paste_control(axes, sigmas): "Paste rows here: id, {axes}, {sigmas}";
    pasted: "Control points, pasted";
    rows_read(all, bad): "{all} rows read, {bad} not understood";
    take_points(n): "Import {n} {n:point|points}";
    measured: "measured";
    not_measured: "not measured in any photo";
    fixed: "held";
    distances: "Distances";
    distance_same_point: "A distance needs two different points.";
    distance_no_point: "Both ends must be points of this project.";
    distance_length: "Enter the length as a positive number, e.g. 1250.4.";
    distance_sigma: "Enter the standard error of this length as a positive number, e.g. 0.02.";
    add_distance: "Add";
    remove_distance: "Remove the distance";
    from_point: "from";
    to_point: "to";
    length: "length";
    unit_of_length: "unit of length";
    unit_of_these: "in";
    choose_unit: "choose…";
    which_unit: "Choose the unit of these coordinates: a wrong one changes the scale, e.g. by 1000.";
    unit_question(from, to, after):
        "The numbers are in {from}. Convert them to {to} (1000 {from} become {after} {to}), or were they in {to} all along?";
    unit_convert: "Convert the numbers";
    unit_relabel: "Only the unit was wrong";
    unit_unknown(unit): "\"{unit}\" is not a known unit of length. Choose the unit of the numbers.";
    unit_unknown_question(from, to): "\"{from}\" is not a known unit, so nothing can be converted. Are the numbers in {to}?";
    unit_is_right: "Yes, change the unit";
    read_separator(separator): "Fields are separated by {separator}.";
    separator_comma: "commas";
    separator_semicolon: "semicolons";
    separator_tab: "tabs";
    separator_blanks: "blanks";
    read_point: "Decimal point.";
    read_comma: "Decimal comma.";
    read_columns(columns): "Columns by the heading: {columns}.";
    read_columns_assumed(columns): "No heading; columns assumed: {columns}.";
    read_ignored(columns): "Not used: {columns}.";
    read_remarks(headings): "Not understood in the heading: {headings}.";
    ask_decimal: "Which number is meant?";
    ask_axes: "The table has no heading for the axes. Which coordinate comes first?";
    axes_xy: "X, east";
    axes_yx: "Y, north";
    in_unit(unit): "in {unit}";
    observed_centres: "Observed projection centres";
    observed_centres_hint: "e.g. from GNSS; used with the datum “Control points”";
    forget_centre: "Stop observing this projection centre";
    observe: "Observe";
    datum: "Datum";
    datum_control: "Control points";
    datum_control_means: "The result is in the coordinate system of the control points; their errors distort the shape.";
    datum_minimal: "Minimal constraints";
    datum_minimal_means: "Holds seven coordinates, which fix position, rotation and scale only. Standard errors depend on which seven.";
    datum_free: "Free network";
    datum_free_means: "Inner constraints over all points give the smallest mean standard error; control points only give initial values.";
} }

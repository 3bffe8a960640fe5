//! Texts of boards of circles whose dots are named.

use super::{English, choose};
use crate::i18n::declare;

declare! { grids {
    circle_grid: "Circle grid";
    how: "Names the dots of a calibration board of circles in all photos";
    name_dots: "Name the dots";
    kind: "Kind";
    symmetric: "symmetric";
    asymmetric: "asymmetric";
    rows: "Rows";
    columns: "Dots in a row";
    pitch: "Distance of rows";
    sigma: "σ of a dot";
    diameter: "Dot diameter";
    hint: "On an asymmetric board the dots of a row are twice the distance of rows apart. With σ the dots are control points (0: held); without, tie points that start from the board's coordinates.";
    first_how: "For a board that looks the same when turned, choose its first dot in a photo before.";
    first_is(target, photo): "Target {target} of photo {photo} is taken for the first dot if the board looks the same when turned.";
    named_in(named, all, observations): "Named in {named} of {all} {all:photo|photos}: {observations} new observations.";
    assumed(n): "The board looks the same when turned. In {n} {n:photo|photos} its rows were taken to run to the right: right if the camera was held the same way up in all of them. Otherwise undo, choose the first dot in a photo and name the dots again.";
    named_before(n): "{n} {n:dot|dots} had another name before and {n:keeps|keep} it.";
    prefixed(prefix): "Other points have these names already: these begin with {prefix}.";
    no_grid(targets): "No grid of dots among the {targets} {targets:target|targets}: show at least 3 × 3 neighbouring dots of the board.";
    not_this_board(dots): "The grid of {dots} dots is no part of this board: check rows, columns and kind.";
    ambiguous(dots, places): "The {dots} visible dots fit {places} places of the board: take a photo that shows more of its dots or its corners.";
    several_boards(count): "{count} grids in the photo may be the board: cover the others, or take a photo of one board.";
    other_dots(dots, others): "An end of the grid of {dots} dots is not in the photo and {others} other dots of their size are: show the whole board, or cover what is beside it.";
    mark(seen): "Targets in the places where the corner mark may be: {seen}; exactly one of them is expected.";
    diameter_apart(seen, given): "The dots have a diameter of {seen} by the pitch and the board's are {given}: check pitch, diameter and kind.";
} }

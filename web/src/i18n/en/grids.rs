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
    pitch: "Row spacing";
    sigma: "σ of a dot";
    diameter: "Dot diameter";
    hint: "On an asymmetric board, the spacing of the dots in a row is twice the row spacing. With a σ, the dots are control points (0: held); without, they are tie points with initial values from the board.";
    first_how: "If the board looks the same when rotated, select its first dot in a photo beforehand.";
    first_is(target, photo): "Target {target} of photo {photo} is used as the first dot if the board looks the same when rotated.";
    named_in(named, all, observations): "Named in {named} of {all} {all:photo|photos}: {observations} new observations.";
    assumed(n): "The board looks the same when rotated. In {n} {n:photo|photos} its rows were assumed to run to the right. This is correct if the camera was held the same way up in all photos. Otherwise undo, select the first dot in a photo and name the dots again.";
    named_before(n): "{n} {n:dot|dots} already had another name and {n:keeps|keep} it.";
    prefixed(prefix): "Other points already have these names, so these begin with {prefix}.";
    no_grid(targets): "No grid of dots among the {targets} {targets:target|targets}. Show at least 3 × 3 neighbouring dots of the board.";
    not_this_board(dots): "The grid of {dots} dots does not fit this board. Check rows, columns and kind.";
    ambiguous(dots, places): "The {dots} visible dots fit the board at {places} places. Take a photo that shows more of its dots or its corners.";
    several_boards(count): "{count} grids in the photo could be the board. Cover the others, or take a photo of one board.";
    other_dots(dots, others): "The grid of {dots} dots is cut off in the photo, and there are {others} other dots of their size. Show the whole board, or cover what is next to it.";
    mark(seen): "Targets at possible places of the corner mark: {seen}; exactly one is expected.";
    change_dots(n): "{n} {n:dot|dots} of a circle grid named";
    no_count(typed): "“{typed}” is not a whole number of at least 2. The earlier value stays.";
    no_length(typed): "“{typed}” is not a length greater than 0. The earlier value stays.";
    no_sigma(typed): "“{typed}” is not a standard error (0 or greater, or empty). The earlier value stays.";
    diameter_apart(seen, given): "The dots have a diameter of {seen} according to the pitch, but {given} is given for the board. Check pitch, diameter and kind.";
} }

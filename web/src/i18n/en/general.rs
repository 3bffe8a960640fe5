//! Texts of the head of the page, its keys, open questions and tables.

use super::{English, choose};
use crate::i18n::declare;

declare! { general {
    // Shell
    start_page: "Sightline, start";
    no_project: "no project open";
    not_saved: "not saved yet";
    steps: "Steps";
    undo: "Undo";
    redo: "Redo";
    switch_language: "Language: switch to Korean";
    switch_theme: "Theme: switch";
    theme_light: "Light";
    theme_dark: "Dark";
    theme_sun: "Sun";
    more_actions: "More";
    dismiss: "Dismiss";
    cancel: "Cancel";
    done_of(done, total): "{done} of {total}";
    version(version): "Version {version}";
    units(unit): "{unit}, degrees, sigma level 1σ";
    in_photos(n): "in {n} {n:photo|photos}";
    worker_lost(detail):
        "The computation failed and its worker was restarted ({detail}). No data are lost. Try again; if memory ran out, use fewer or smaller photos.";

    // Keys
    keys_title: "Keyboard shortcuts";
    keys_note: "Shortcuts are off while you type.";
    single_keys: "single-letter shortcuts";
    close: "Close";
    keys_everywhere: "Everywhere";
    keys_measuring: "Measuring";
    keys_in_photo: "In the photo";
    keys_in_tables: "In tables";
    key_escape: "clear selection or question";
    key_yes: "yes: accept the target in question";
    key_no: "no; or the next photo of the point";
    key_doubtful: "next doubtful";
    key_exclude: "exclude or restore the selected observation; also in the table of points";
    key_photos: "next and previous photo";
    key_arrows: "move the selection by 1 px, Shift 10, Alt 0.1; without one, move the cross";
    key_enter: "measure at the cross";
    key_one_to_one: "1:1";
    key_zoom: "zoom";
    key_pan: "hold to pan";
    key_cells: "from cell to cell";
    key_range: "select a range";
    key_all: "select all";
    key_edit: "type into the cell";

    // Open questions
    questions: "Questions";
    question_of(n, all): "Question {n} of {all}";
    is_this(point): "Is this point {point}?";
    which_is_this: "Which point is this?";
    no: "No";
    other: "another";
    next_question: "Next";
    answer_them: "Answer them";
    no_questions: "No question is open.";

    // Tables
    observations_table: "Observations";
    file: "file";
    width: "width";
    height: "height";
    model: "model";
    point_column: "point";
    target_column: "target";
    code: "code";
    all_rows: "all";
    few_rays: "rays < 3";
    large_w: "|w| too large";
    marked_rows: "selected";
    rows_shown(shown, all): "{shown} of {all} {all:row|rows} shown. Enter edits a cell; Shift and Control select rows.";
    filter_text: "find by name";
    conditions: "Rows to show";
    rows_marked(n): "{n} selected";
    exclude: "Exclude";
    restore: "Restore";
    rename_many: "Rename…";
    merge: "Merge";
    split: "Split off";
    join_cameras: "Merge cameras";
    fill_down: "Fill down";
    delete_rows: "Delete";
    paste: "Paste";
    pattern: "pattern";
    pattern_start: "from";
    pattern_hint: "A row of # stands for the number, * for the old name: P### gives P001, P002, in the order of the names.";
    nearest_tolerance: "maximum distance";
    rename_nearest(n): "Name by the nearest of {n} given points";
    nearest_hint: "To name points by the nearest given coordinates, open their list at the step Control, scale first.";
    nearest_none: "No adjusted point is that close to a given one.";
    paste_cells: "Paste rows here (Ctrl+V)";
    plan_counts(good, bad, lost): "{good} {good:cell|cells} to change, {bad} refused, {lost} {lost:line|lines} without a matching row";
    take_changes: "Apply";
    value_of_cell: "Value of the cell";
    refused_no_row: "This row no longer exists.";
    refused_not_editable: "This column cannot be changed.";
    refused_flag(typed): "\"{typed}\" is neither yes nor no: type 1 or 0.";
    refused_role(typed): "\"{typed}\" is not a role: type tie, control or check.";
    refused_camera(typed): "There is no camera \"{typed}\": type the name of one of this project.";
    cells_refused(n, why): "{n} {n:cell was|cells were} not changed: {why}";
    nothing_to_delete: "Nothing was deleted: a camera that has photos cannot be deleted.";
    merge_clash(photo): "Photo {photo} shows both: they cannot be one point.";
    split_one_point: "Select observations of one point only. They become a new point.";
    split_leaves_nothing: "All observations of the point are selected. Leave at least one.";
    name_twice(name): "Two points would have the name {name}: add a row of # to the pattern.";
    cameras_differ: "Only cameras with photos of the same size can be merged.";
    change_cells(n, table): "{n} {n:cell|cells} edited, {table}";
    change_rows_excluded(n, table): "{n} {n:row|rows} excluded, {table}";
    change_rows_restored(n, table): "{n} {n:row|rows} restored, {table}";
    change_rows_deleted(n, table): "{n} {n:row|rows} deleted, {table}";
    change_roles(n, role): "role of {n} {n:point|points} set to {role}";
    change_merged(n, into): "{n} points merged into {into}";
    change_split(point, new): "point {new} split off point {point}";
    change_points_renamed(n): "{n} {n:point|points} renamed";
    change_cameras_joined(n, into): "{n} cameras merged into {into}";
    change_question(photo): "question in photo {photo} answered";
} }

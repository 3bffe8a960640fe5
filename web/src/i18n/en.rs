//! The texts in English, by which every other language is checked: labels are noun phrases, advice is full sentences.
//!
//! `{n}` is a value; `{n:photo|photos}` is the word for one or for any other number of them.

use sightline::error::{Damage, Lack, PictureKind, Reason, Thing};
use sightline::initial::Degeneracy;
use sightline::project::ReportLanguage;

use super::declare;

mod before;
mod beginning;
mod beside;
mod exchange;
mod gridded;
mod laid_open;
mod listed;
mod modelled;
mod monitored;
mod patterned;
pub use before::{planning, printing};
pub use beginning::first;
pub use beside::{comparing, equipment, lasting};
pub use exchange::interchange;
pub use gridded::grids;
pub use laid_open::inside;
pub use listed::lists;
pub use modelled::modelling;
pub use monitored::monitoring;
pub use patterned::systematic;

/// This language.
pub struct English;

impl super::Speech for English {
    fn tag(&self) -> &'static str {
        "en"
    }
    fn name(&self) -> &'static str {
        "English"
    }
    fn pages(&self) -> ReportLanguage {
        ReportLanguage::English
    }
    fn ignored(&self, name: &str) -> String {
        name.to_owned()
    }
    fn reason(&self, reason: &Reason) -> String {
        reason.to_string()
    }
    fn damage(&self, damage: &Damage) -> String {
        damage.to_string()
    }
    fn degeneracy(&self, degeneracy: &Degeneracy) -> String {
        degeneracy.to_string()
    }
    fn picture(&self, kind: &PictureKind) -> String {
        kind.to_string()
    }
    fn thing(&self, thing: Thing) -> &'static str {
        thing.name()
    }
    fn lack(&self, lack: Lack) -> &'static str {
        lack.name()
    }
}

fn choose<'a>(value: &str, one: &'a str, other: &'a str) -> &'a str {
    if value == "1" { one } else { other }
}

declare! { desk {
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
        "The computation broke off and its worker was replaced ({detail}). Nothing was lost; try again, with fewer or smaller photos if memory ran out.";

    // Start
    formats: "JPEG, HEIC, RAW, PNG, TIFF and BMP, 8 or 16 bit. RAW is measured on the sensor's own samples.";
    choose_photos: "Choose photos…";

    // Photos and cameras
    photos: "Photos";
    photos_sentence(photos, cameras):
        "{photos} {photos:photo|photos}, {cameras} {cameras:camera|cameras}. Photos of the same make, model, size and focal length share a camera.";
    add_photos: "Add photos…";
    on_to_targets: "Targets";
    opening_photos: "Opening photos";
    being_read: "Being read";
    photo_count(n): "{n} {n:photo|photos}";
    rows_damaged(photo, rows): "Photo {photo}: rows {rows} of the file are damaged and were not measured";
    page_measured(photo, number, of): "Photo {photo}: picture {number} of the {of} in the file is measured, the first of full resolution";
    first_page_measured(photo, of): "Photo {photo}: the file has {of} pictures; the first is measured";
    photo_failed(photo, reason): "Photo {photo}: {reason}";
    no_photo_files: "No photo file is here: drop the photos of this project to work on them.";
    photo_file_missing(file): "The file {file} is not here. Drop it on this page to see it.";
    not_taken: "Not taken";
    duplicate_of(file): "the same content as {file}, which is here already";
    same_name_as(photo): "it has the name of photo {photo} of this project; it is not attached before you choose";
    photos_differ(n, names):
        "{n} {n:file|files} with the name of a photo of this project, but other contents: {names}. Add as new photos, or replace the project's photos and remove what was measured in them?";
    photos_unrecorded(n, names):
        "{n} {n:file|files} with the name and size of measured photos: {names}. The project does not record their contents. Are they the same photos?";
    same_photos: "The same photos";
    add_as_new: "Add as new photos";
    replace_photos: "Replace, remove measurements";
    developed_of(file): "the same shot as {file}, which is measured, on the sensor's own samples";
    raw_of(file): "the same shot as {file}, which is here already; in the RAW file the sensor's own samples are measured";
    measure_raw: "Measure the RAW files instead";
    measure_developed: "Measure the developed photos instead";
    unreadable(detail): "the browser could not read the file: {detail}";
    cameras: "Cameras";
    camera: "Camera";
    camera_named(name): "Camera {name}";
    camera_of_their_own: "a camera of their own";
    picked_photos(n): "{n} {n:photo|photos} chosen";
    take_part: "take part in the adjustment";
    remove_from_project: "Remove from the project";
    make_and_model: "make, model";
    focal_length: "focal length";
    film_equivalent(mm): "{mm} mm on 35 mm film";
    not_in_exif: "not in EXIF";
    name: "name";
    name_taken(name): "The name \"{name}\" is empty or in use: names are unique.";
    not_a_length(typed): "\"{typed}\" is no positive number: type one such as 3.19.";
    not_a_count(typed): "\"{typed}\" is no count: type a whole number such as 5.";
    no_sigma(typed): "\"{typed}\" is no standard error: type a number above 0, or nothing.";
    centre_without_sigma: "An observed projection centre needs a standard error on one axis at least.";
    pixel_pitch: "pixel pitch";
    pitch_um(um): "pitch {um} µm";
    pitch_unknown: "pitch unknown, in pixels";
    pitch_hint: "Without a pixel pitch photo coordinates are in pixels; the object points are the same either way.";
    principal_distance: "principal distance, initial";
    unknown: "unknown";

    // Report
    report: "Report";
    report_sentence: "The page set that is handed over. Every number has its unit and sigma level.";
    report_figure: "ready";
    write_report: "Write report";
    print_or_pdf: "Print or save PDF";
    save_html: "Save HTML";
    writing_report: "Writing the report";
    report_settings: "What the report has";
    report_preview: "Report as it is printed";
    report_sections: "Sections";
    section_summary: "Summary";
    section_uncertainty: "Uncertainty (GUM)";
    section_observations: "Observations and unknowns";
    section_network: "Network";
    section_control: "Control, check points, scale";
    section_lengths: "Length errors (VDI/VDE 2634)";
    section_statistics: "Statistics and tests";
    section_left_out: "Left out, and why";
    section_settings: "Settings and inputs";
    section_all_observations: "All image observations";
    report_language: "Language of the report";
    paper_size: "Paper";
    first_page: "First page";
    report_title: "Title (else the project’s name)";
    measured_by: "Measured by";
    date_of_report: "Date (else today)";
    free_text: "Text";
    choose_logo: "Choose logo…";
    remove_logo: "Remove logo";
    logo_kind: "A logo is a PNG or JPEG file.";
    logo_size: "This picture is larger than 1 MB: take a smaller one as a logo.";
    statements: "Statements of accuracy";
    coverage_factor: "Coverage factor k";
    limit_constant(unit): "Permitted length error A, {unit}";
    limit_per: "K of A + L / K";
    limit_hint: "Compared with the distances that are marked as check only under control and scale.";
    check_only: "check only";
    check_only_means: "Compared with the result, takes no part in the adjustment";
    change_report: "report edited";

    // Results: plots and meanings
    tables: "Tables";
    plots: "Plots";
    meanings: "What the numbers mean";
    what_it_means: "What it means";
    what_to_do: "What to do:";
    source: "Source";
    residuals_of_photos: "Residuals, photo by photo";
    drawing_plots: "Drawing the plots";
    save_svg: "Save SVG";
    sigma0_name: "σ₀, standard deviation of unit weight";
    sigma0_means: "How large the residuals are beside what was assumed of the observations: 1 where the assumption is right. Every standard deviation of the result contains it.";
    sigma0_do: "Well above 1: look for gross errors, then for an unmodelled part of the camera; if both are settled, the assumed standard deviations are too small. Well below 1: they are too large.";
    global_name: "Global test";
    global_means: "Whether σ₀ can differ from 1 by chance. The test fails by chance in 5 of 100 adjustments that are in order.";
    global_do: "Failed and σ₀ above 1: start with the worst observations. Failed and below 1: only the assumption is too careful, the coordinates are the same.";
    redundancy_means: "How many observations are more than needed: these check the others.";
    redundancy_do: "Small redundancy hides errors: measure points in more photos, add photos.";
    rms_residual_means: "How well the adjusted rays meet the measured places in the photos, in pixels.";
    rms_residual_do: "With good targets some hundredths of a pixel. More: targets out of focus, wrong identities, or a lens the model does not describe.";
    rms_sigma_means: "The precision of a coordinate, in the mean over all tie points, at 1σ. It tells how observations repeat, not what is systematically wrong: check points tell that.";
    rms_sigma_do: "For better figures: photos at larger angles, a closer or longer lens, more rays per point.";
    relative_means: "The largest dimension of the object over the mean standard deviation: it compares networks of different size.";
    relative_do: "1 : 5 000 is a camera held by hand, 1 : 100 000 a calibrated network of targets.";
    check_rms_means: "Differences at points that were known beforehand and took no part: the one independent statement about accuracy here.";
    check_rms_do: "Much larger than the standard deviations say: scale, datum or the check points themselves are wrong, or the camera is.";
    w_name: "w, test of a single observation";
    w_means(limit): "A residual in units of its own standard deviation. Beyond {limit} it is one in a thousand by chance.";
    w_do: "Look at the largest in its photo first: one gross error enlarges others. Measure again or exclude, then adjust again.";
    r_name: "r, redundancy number";
    r_means: "The share of an error in this observation that shows in its own residual: 1 all of it, 0 nothing.";
    r_do: "Below 0.1 a gross error stays unseen: give its point more rays or its photo more points.";
    mdb_name: "Detectable error and its effect";
    mdb_means: "The smallest error of an observation that the test finds with a power of 80 %, and how far it moves a coordinate while it stays undetected.";
    mdb_do: "An effect that is larger than the tolerance asks for more checks just there.";
    significance_name: "Significance of a parameter";
    significance_means: "A parameter of distortion in units of its standard deviation: below 2 it is not told from 0.";
    significance_do: "Hold it at 0, or keep it where the calibration is to be used elsewhere.";
    correlation_name: "Correlation";
    correlation_means(limit): "How far two parameters stand in for each other: beyond {limit} they are known together only.";
    correlation_do: "Roll the camera by 90°, vary depth and direction; or hold the finer of the two.";

    // Photo view
    photo_view(photo): "Photo {photo}";
    fit: "Fit";
    loupe: "loupe";
    legend_measured: "measured";
    legend_selected: "selected";
    legend_doubtful: "doubtful";
    legend_excluded: "excluded";

    // Targets
    targets: "Targets";
    target: "Target";
    targets_none_yet: "Bright and dark circular targets are found, measured and, where they carry a ring code, named.";
    targets_sentence(targets, coded, photos):
        "{targets} {targets:target|targets} in {photos} {photos:photo|photos}, {coded} of them coded.";
    targets_coded(targets, coded): "{targets} {targets:target|targets}, {coded} coded";
    detect: "Detect targets";
    detect_again: "Detect again";
    detecting: "Detecting";
    polarity: "targets";
    polarity_both: "bright and dark";
    polarity_bright: "bright on dark";
    polarity_dark: "dark on bright";
    channel: "channel";
    channel_grey: "grey";
    channel_red: "red";
    channel_green: "green";
    channel_blue: "blue";
    codes: "ring codes";
    codes_auto: "automatic";
    codes_none: "none";
    codes_of(family): "Codes: {family}.";
    codes_of_several: "The rings can be read as codes of several families. Which are they?";
    codes_different: "The rings are not all codes of one family, and none was named: choose the family under ring codes.";
    code_candidates: "code unclear, perhaps";
    method: "method";
    method_least_squares: "least squares";
    method_ellipse: "ellipse on edges";
    method_intensity: "intensity centroid";
    method_gradient: "gradient centroid";
    diameter: "diameter";
    diameter_from: "smallest diameter in pixels";
    diameter_to: "largest diameter in pixels";
    steepest: "steepest view";
    steepest_view: "largest angle between the line of sight and a target's normal, in degrees";
    no_steepest(typed): "\"{typed}\" is no angle of a view: type degrees from 0 to 81.";
    click_a_target: "Click a target in the photo to see its centre and sigma.";
    full_axes: "full axes";
    rotation: "rotation";
    contrast: "contrast";
    edge_width: "edge width";
    code_not_read: "code not read";
    code_all_set: "the ring is set all around";
    code_no_code: "its bits are no code of the family";
    code_disturbed: "something lies beside the ring or on it";
    code_between_levels: "a sector lies between light and dark";
    code_other_family: "its sectors may be those of another family, or dots around it";
    code_uncertain: "its ring may look like a code by chance: it is small, blurred or a single arc";
    code_several_families: "it is a code of several families";
    code_unread: "two or more ellipses stand where a ring has its sectors; they are no targets";
    inner_rim: "inner rim, distance of the centres";
    inner_rim_centred: "the centres agree";
    inner_rim_off: "the centres differ by more than their standard errors; the outer rim counts";
    picture_sharpened(percent, radius): "sharpened by {percent} % (radius {radius} px), undone where that hides targets";
    picture_overexposed(percent): "{percent} % over-exposed, left out of the fits";
    picture_black(percent): "{percent} % without light, where nothing shows";
    picture_compressed(percent): "JPEG compression is visible (block borders {percent} % stronger) and counts as noise";
    picture_compressed_uncounted(percent):
        "JPEG compression is visible (block borders {percent} % stronger), which the standard errors of this method do not count: they are too small (measure with least squares)";
    picture_noise(noise): "noise {noise} grey levels, from which the standard errors follow";
    picture_shared_noise(noise, factor):
        "noise {noise} grey levels, shared by neighbouring pixels, which makes the standard errors {factor} times as large";
    picture_sentence(what): "This photo: {what}.";
    measured_on_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured on the sensor's own {colour} sites ({pattern}), each by itself.";
    measured_between_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured in a picture between the {colour} sites ({pattern}), as this method needs one.";
    measured_noise(read, gain): "Noise estimated from the photo: {read} without light, its variance growing by {gain} per unit of light.";
    measured_light_noise(gain): "Noise estimated from the photo: its variance grows by {gain} per unit of light; without light it cannot be seen here.";
    measured_read_noise(read): "Noise estimated from the photo: {read} in every light.";
    measured_overexposed(percent): "{percent} % over-exposed, left out of the fits.";
    measured_hot(count): "{count} hot sites left out.";
    measured_corrections(names):
        "The file names corrections of its lens ({names}). None was made here: a camera calibrated in corrected pictures is another camera.";
    unread_corrections: "A list of corrections of the lens in the file cannot be read: what it names is not known, and nothing of it was made.";
    corrections_made(names):
        "The camera's note says that it corrected: {names}. Its distortion is what the correction left, not the lens's: calibrate and measure with the same setting; it changes with zoom and focus.";
    corrections_without_distortion(names): "The camera's note says that it corrected: {names}. Distortion is not among them.";
    corrections_of_developed(names):
        "The camera's note asks for corrections of pictures developed from this file: {names}. None was made here: a camera calibrated in corrected pictures is another camera.";
    corrections_off(names): "It says that it left uncorrected: {names}.";
    correction_of(what, tag): "{what} ({tag})";
    correction_auto(what, tag): "{what}, where it knows the lens ({tag})";
    aberration_distortion: "distortion";
    aberration_lateral_colour: "lateral colour";
    aberration_vignetting: "vignetting";
    aberration_diffraction: "diffraction";
    site_red: "red";
    site_green: "green";
    site_blue: "blue";
    site_cyan: "cyan";
    site_magenta: "magenta";
    site_yellow: "yellow";
    site_white: "unfiltered";
    site_emerald: "emerald";
    colours_apart: "Colours apart";
    colours_apart_hint: "A lens images red and blue a little larger or smaller than green. Measured in all three, the targets show how much.";
    measure_colours: "Measure red and blue";
    measuring_colours: "Measuring red and blue…";
    hold_colours: "Hold in the camera";
    hold_colours_again: "Hold these instead";
    forget_colours: "Add nothing for other colours";
    lens_colour: "colour";
    colour_difference: "difference";
    colours_hold_means(camera): "Camera {camera} can hold these differences: they are added to its parameters, and held, for photos measured in red or blue.";
    colours_are_held(camera): "Camera {camera} holds differences for other colours: they are added to its parameters, and held, for photos measured in red or blue.";
    apart_at_corner(colour, pixels, sigma, count): "{colour}: {pixels} px against green at the corner (standard error {sigma} px), from {count} targets";
    apart_too_few(colour, count): "{colour}: {count} targets in both colours are too few to tell";
    apart_outwards: "px outwards";
    apart_radius(pixels): "radius up to {pixels} px";
    rejected_here: "Rejected in this photo";
    reason_too_small: "too small";
    reason_too_large: "too large";
    reason_not_an_ellipse: "not an ellipse";
    reason_too_flat: "too flat";
    reason_low_contrast: "low contrast";
    reason_touching: "touching another";
    reason_saturated: "saturated";
    reason_at_border: "at the border";
    reason_occluded: "hidden";
    reason_code_ring: "part of a code ring";
    reason_no_fit: "no fit";

    // Project
    project_name: "Project name";
    saved_at(clock): "saved {clock}";
    saved_without_photos(clock, n): "saved {clock}, {n} {n:photo|photos} not";
    changed_after(clock): "changed since {clock}";
    save: "Download project file";
    save_all: "Download with photos";
    save_hint: "Download the project file without the photos";
    save_all_hint: "Download the project file with the photos in it, as the camera wrote them: with the place where they were taken (GPS) if they have it";
    photos_carry_places: "The photos in the file are as the camera wrote them, with the place where they were taken (GPS) if they have it.";
    save_with_photos: "Save the project file with the photos in it";
    saving: "Saving";
    cannot_save(detail): "The file could not be saved: {detail}";
    open_project: "Open project…";
    opening_project: "Opening the project";
    open_sample: "Open the sample project";
    sample_words: "A panel with coded and plain targets in computer-generated photos. Opens adjusted in one click.";
    sample_name: "Sample";
    opening_sample: "Rendering, measuring and adjusting the sample";
    busy: "Wait for the work under way to end, or cancel it first.";
    waits_at_identities(file): "{file} holds image measurements and waits under Point names.";
    waits_at_control(file): "{file} holds control points and waits under Control, scale.";
    marks_or_control(file): "{file} can be read as marks (photo, point, u, v) or as control points (id, X, Y, Z). Which is it?";
    is_empty: "the file is empty";
    file_empty(file): "{file}: the file is empty.";
    is_no_list: "neither marks (photo, point, u, v) nor control points (id, X, Y, Z) are in it";
    unsaved_here: "This project has changes that are not saved.";
    unsaved_in(name): "{name} has changes that are not saved.";
    save_first: "Save with photos, then open";
    go_on_unsaved: "Open without saving";
    undo_this(what): "Undo: {what}";
    redo_this(what): "Redo: {what}";
    out_of_date: "out of date";
    n_iterations(n): "{n} iter.";
    photos_and_targets(done, total, targets): "photo {done} of {total} · {targets} {targets:target|targets}";
    iteration_of(done, total): "iteration {done} of at most {total}";
    copy: "Copy";
    show: "Show";
    discard: "Discard";
    found_by_orientation: "unknown: found";
    not_zero_or_more(typed): "\"{typed}\" is not 0 or more: type a number of pixels such as 0.1.";
    not_a_number(typed): "\"{typed}\" is no number: type one such as -0.0034.";
    ambiguous_number(typed, decimal, thousands):
        "\"{typed}\" can be read in two ways: {decimal} with a decimal comma, {thousands} with a thousands separator. Type one of the two.";
    ambiguous_short: "A comma before three digits can be read in two ways: type 1.234 or 1234.";

    // What this browser keeps
    recent_projects: "Recent projects";
    on_this_computer: "on this computer, as they were left";
    project: "project";
    column_photos: "photos";
    column_points: "points";
    column_changed: "changed";
    open_now: "open";
    without_name: "Project without a name";
    go_on: "Open";
    go_on_with(name): "Open {name}";
    more_with(name): "More for {name}";
    rename_project: "Rename";
    duplicate: "Duplicate";
    download: "Download with photos";
    delete_project: "Delete";
    copy_of(name): "{name} (copy)";
    deleted(name): "{name} was deleted.";
    writing: "saving…";
    not_written: "not saved: see below";
    following: "read-only, open in another window";
    copying_photos(n): "copying photos, {n} left";
    open_elsewhere: "This project is open in another window. What is done there is seen here; to work here, take it over.";
    take_over: "Take over";
    reads_along: "Read-only: the project is open in another window. Take it over to change it.";
    other_is_kept(name): "{name} is kept on this computer; the start page has it.";
    held_elsewhere: "The project is open in another window. Do this there, or close that window first.";
    kept_as_copy(name, copy): "Another window took {name} over before the last changes here were stored. They are kept as a project of its own, {copy}.";
    storage_ended: "the storage of this browser does not start again";
    list_unreadable(detail): "The list of projects could not be read ({detail}). The projects are still stored: reload the page, or close its other windows.";
    unreadable_project: "Project that cannot be read";
    journal_mended: "One bit of this stored project had changed. It was repaired, and nothing is lost. The damaged file can be downloaded from the start page.";
    journal_damaged(n): "This stored project was damaged. The newest state that can be read is open; {n} newer {n:state|states} and the undo history are lost. The damaged file can be downloaded from the start page.";
    journal_end_damaged: "The end of this stored project was damaged: the last change is lost. The damaged file can be downloaded from the start page.";
    journal_to_be_opened: "This stored project is damaged. Open it first: what can be read of it is then stored anew.";
    download_damaged: "Download damaged file";
    wipe: "Delete everything stored by this page…";
    licences: "Licences of the software in this page";
    wipe_question: "Delete all projects with their photos, the equipment, the preferences and the offline copy of this page from this browser? This cannot be undone.";
    wipe_now: "Delete everything";
    gone_for_good: "This project is no longer stored in this browser.";
    deleted_projects: "Deleted projects";
    deleted_for_a_day: "kept for a day";
    put_back: "Put back";
    keeps_nothing: "This browser keeps nothing here. Save the project before you close the page.";
    storage_full: "The storage of this computer is full: the last changes are in this page only. Save the project as a file, or delete projects you no longer need.";
    not_kept(detail): "The last changes could not be stored and are in this page only ({detail}). Save the project as a file.";
    photos_not_copied(n, detail):
        "{n} {n:photo is|photos are} not copied into the browser's storage ({detail}). They are needed again when the project is reopened, unless it is saved with photos.";
    no_room: "no room";
    kept_unreadable(detail): "What is stored could not be read ({detail}). Nothing of it was deleted. If it is damaged, the start page offers the damaged file for download.";
    kept_by_newer(version): "A newer version of Sightline stored this project (format {version}). Reload the page to get that version.";
    storage_cleared(n): "The browser has cleared its storage: {n} {n:project is|projects are} gone from this list. Open them from their saved files.";
    cleared_under_page: "The browser cleared its storage while this page was open. The project is stored again as it is here, photos and all; other projects are gone. Save it as a file too: what was cleared once may be cleared again.";
    cleared_with_photos(n): "The browser cleared its storage while this page was open. The project is stored again as it is here; {n} {n:photo|photos} went and {n:has|have} to be dropped on the page again. Save it as a file too: what was cleared once may be cleared again.";
    held_by_windows: "The browser cleared its storage, and another window of this page still holds files of it: close the other windows. Until then the project is in this page only; save it as a file.";
    space_used(used, all): "{used} of {all} used";
    lasts: "kept when space runs short";
    may_be_cleared: "the browser may clear it when space runs short";
    part_did_not_come: "This part of the page could not be loaded. Check the network connection.";
    try_again: "Try again";
    no_network: "No network. Everything on this page works without it.";
    no_network_nor_copy: "No network. What is open works; the page cannot be loaded again before the network is back.";
    needs_network: "the page loads only with the network";
    another_build: "The host has another version of Sightline by now, and the rest of this version does not come any more. Reload the page; projects stay as they are.";
    reload_page: "Reload";
    not_on_clipboard: "The browser did not let the page copy to the clipboard. Select the cells and copy them with the keyboard, or export the table.";
    update_ready: "A new version of Sightline is here. Projects stay as they are.";
    take_update: "Reload with it";

    // Identities
    identities: "Point names";
    identities_sentence(named, points, single):
        "{named} {named:observation|observations} of {points} {points:point|points}; {single} {single:point|points} in one photo only.";
    open_marks: "Open marks…";
    matching: "Matching";
    matched(found, doubtful):
        "{found} {found:observation|observations} of uncoded targets matched; {doubtful} {doubtful:target|targets} are doubtful and were left without a name.";
    control: "Control";
    id: "id";
    rays: "rays";
    role: "role";
    role_tie: "tie";
    role_control: "control";
    role_check: "check";
    doubt: "doubt";
    doubt_duplicate(photo): "code read twice in photo {photo}";
    doubt_code_family(photo): "family of the code not known in photo {photo}";
    doubt_code_unclear(photo): "code not clear in photo {photo}";
    doubt_ambiguous(photo): "fits more than one way in photo {photo}";
    doubt_disagrees(photo): "disagrees with the other rays in photo {photo}";
    one_ray: "in one photo only";
    no_ray: "not measured";
    points: "Points";
    point: "Point";
    points_column: "points";
    photo: "photo";
    named_of(named, targets): "{named} named of {targets} {targets:target|targets}";
    name_this_target: "Name of this target";
    take_name: "Take";
    marks: "Marks";
    snap_radius: "snap radius";
    snapped_sentence(good, all): "{good} of {all} {all:mark|marks} lie at a measured centre.";
    take_marks(n): "Import {n} {n:measurement|measurements}";
    why_not: "not taken because";
    unsnapped_no_detection: "no targets were detected in this photo";
    unsnapped_no_target: "no target within the radius";
    unsnapped_contested(points): "as near to the same target as {points}";
    unsnapped_twice: "marked twice in this photo";
    remove_point: "Remove the point";
    remove_observation: "Remove the observation";
    take_part_short: "takes part";
    placed_by_hand: "Placed by hand, with σ 0.5 px.";
    nothing_to_measure: "There is no target to measure here. Alt-click, or \"Place freely\", takes the place itself.";
    place_freely: "Place freely";
    place_freely_how: "Clicks take the place itself, with σ 0.5 px; Alt-click does so at any time";
    click_measures: "Click measures, Alt-click places freely";
    name_this_place: "Name of this place";
    no_name: "no name";
    rename_where: "renames";
    in_all_photos(n): "in all {n} {n:photo|photos}";
    in_this_photo(photo): "in photo {photo} only";
    rename_says(n): "Renames the point in all its {n} {n:photo|photos}. The name of an existing point merges both points.";
    rename_here_says(photo): "Only what photo {photo} shows gets the new name; the other photos keep theirs.";
    point_renamed(from, to, n): "Point {from} is now {to}, in {n} {n:photo|photos}.";
    points_joined(from, to, n): "Points {from} and {to} are one now: {to}, in {n} {n:photo|photos}.";
    name_taken_from(before, photo, point):
        "This place was point {before} in photo {photo}; it is {point} now. The other photos keep {before}.";
    name_moved(point, photo): "Point {point} was elsewhere in photo {photo}; that place has no name now.";
    point_went(point): "Point {point} was measured nowhere else and went with its last observation.";
    both_in_photo(from, to, photo): "Photo {photo} shows both {from} and {to}: they cannot be one point.";

    // Measuring by hand
    measuring_by_hand: "Measuring by hand";
    point_by_point: "Point by point";
    point_by_point_how: "Each click measures a point and shows the next photo that should have it (M)";
    click_next_point: "Click the next point.";
    click_point_here(point): "Click point {point} here.";
    point_is_measured_here(point): "Point {point} is measured here.";
    is_it(point, off, reach): "Is this target point {point}? It lies {off} px from where it should be (3σ {reach} px).";
    is_it_of_two(point, off, reach, second):
        "Is this target point {point}? It lies {off} px from where it should be (3σ {reach} px), a second one {second} px.";
    is_it_near(point, off): "Is this target point {point}? It lies {off} px from where it should be; how far off that may be is known once the photos are adjusted.";
    should_be_near(point): "Point {point} should be near here; how near is known once the photos are adjusted. Measure there?";
    should_be_here(point, reach): "Point {point} should be here, 3σ {reach} px: measure there?";
    yes: "Yes";
    next_place: "Next photo";
    next_point: "Next point";
    in_all_it_should_be: "The point is measured in every photo that should show it.";
    this_point_in_photos: "This point in its photos";
    predicted: "predicted";
    off_by(px): "{px} px off";
    not_in(n): "not in {n} {n:photo|photos}";
    layers: "Layers";
    layer_ellipses: "ellipses";
    layer_names: "names";
    layer_predicted: "where the point should be";
    layer_epipolar: "epipolar lines";
    layer_residuals: "residuals";
    layer_pixels: "pixel grid, grey values";
    residual_factor: "How many times their length residuals are drawn";
    times(n): "{n} times";
    brightness: "brightness";
    picture_contrast: "contrast";
    as_it_is: "As it is";

    // Keys
    keys_title: "Keys";
    keys_note: "Keys rest while something is typed.";
    single_keys: "single-letter shortcuts";
    close: "Close";
    keys_everywhere: "Everywhere";
    keys_measuring: "Measuring";
    keys_in_photo: "In the photo";
    keys_in_tables: "In tables";
    key_escape: "clear selection or question";
    key_yes: "yes: take the target that is asked for";
    key_no: "no; or the next photo of the point";
    key_doubtful: "next doubtful";
    key_exclude: "exclude or restore the chosen observation; in the table of points too";
    key_photos: "next and previous photo";
    key_arrows: "move what is chosen by 1 px, Shift 10, Alt 0.1; else the cross";
    key_enter: "measure at the cross";
    key_one_to_one: "1:1";
    key_zoom: "zoom";
    key_pan: "hold to pan";
    key_cells: "from cell to cell";
    key_range: "mark a range";
    key_all: "mark all";
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
    marked_rows: "marked";
    rows_shown(shown, all): "{shown} of {all} {all:row|rows} shown. Enter types into a cell; Shift and Control mark rows.";
    filter_text: "find by name";
    conditions: "Which rows";
    rows_marked(n): "{n} marked";
    exclude: "Exclude";
    restore: "Restore";
    rename_many: "Rename…";
    merge: "Merge";
    split: "Split off";
    join_cameras: "Make one camera";
    fill_down: "Fill down";
    delete_rows: "Delete";
    paste: "Paste";
    pattern: "pattern";
    pattern_start: "from";
    pattern_hint: "A row of # is the number, * the old name: P### gives P001, P002, in the order of the names.";
    nearest_tolerance: "not farther than";
    rename_nearest(n): "Name by the nearest of {n} given points";
    nearest_hint: "To name points by the nearest given coordinates, open their list at the step Control, scale first.";
    nearest_none: "No adjusted point lies so near to a given one.";
    paste_cells: "Paste rows here (Ctrl+V)";
    plan_counts(good, bad, lost): "{good} {good:cell|cells} to change, {bad} refused, {lost} {lost:line|lines} without a row";
    take_changes: "Apply";
    value_of_cell: "Value of the cell";
    refused_no_row: "There is no such row any more.";
    refused_not_editable: "This column cannot be changed.";
    refused_flag(typed): "\"{typed}\" is neither yes nor no: type 1 or 0.";
    refused_role(typed): "\"{typed}\" is no role: type tie, control or check.";
    refused_camera(typed): "There is no camera \"{typed}\": type the name of one of this project.";
    cells_refused(n, why): "{n} {n:cell was|cells were} not changed: {why}";
    nothing_to_delete: "Nothing was deleted: a camera stays while photos are of it.";
    merge_clash(photo): "Photo {photo} shows both: they cannot be one point.";
    split_one_point: "Mark observations of one point only: they become a point of their own.";
    split_leaves_nothing: "All observations of the point are marked: leave one to it at least.";
    name_twice(name): "Two points would be called {name}: put a row of # into the pattern.";
    cameras_differ: "Only cameras whose photos have the same size can be one.";
    change_cells(n, table): "{n} {n:cell|cells} edited, {table}";
    change_rows_excluded(n, table): "{n} {n:row|rows} excluded, {table}";
    change_rows_restored(n, table): "{n} {n:row|rows} restored, {table}";
    change_rows_deleted(n, table): "{n} {n:row|rows} deleted, {table}";
    change_roles(n, role): "{n} {n:point is|points are} {role} now";
    change_merged(n, into): "{n} points merged into {into}";
    change_split(point, new): "point {new} split off point {point}";
    change_points_renamed(n): "{n} {n:point|points} renamed";
    change_cameras_joined(n, into): "{n} cameras made one, {into}";
    change_question(photo): "question in photo {photo} answered";

    // Control and scale
    control_and_scale: "Control, scale";
    control_sentence(control, check, distances):
        "{control} {control:control point|control points}, {check} check {check:point|points}, {distances} {distances:distance|distances}.";
    open_control: "Open control points…";
    control_points: "Control points";
    paste_control: "Paste rows here: id, X, Y, Z, sX, sY, sZ";
    pasted: "Control points, pasted";
    rows_read(all, bad): "{all} rows read, {bad} not understood";
    take_points(n): "Import {n} {n:point|points}";
    measured: "measured";
    not_measured: "not measured in any photo";
    fixed: "fixed";
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
    which_unit: "Say in which unit these coordinates are: a sheet of 1 m must not become one of 1 mm.";
    unit_question(from, to, after):
        "The numbers are in {from}. Convert them to {to} (1000 {from} become {after} {to}), or were they in {to} all along?";
    unit_convert: "Convert the numbers";
    unit_relabel: "Only the unit was wrong";
    unit_unknown(unit): "\"{unit}\" is not a known unit of length. Choose the unit of the numbers.";
    unit_unknown_question(from, to): "\"{from}\" is not a known unit, and nothing can be converted from it. Are the numbers in {to}?";
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
    ask_axes: "The table has no heading that tells the axes. Which coordinate comes first?";
    axes_xy: "X, east";
    axes_yx: "Y, north";
    in_unit(unit): "in {unit}";
    observed_centres: "Observed projection centres";
    observed_centres_hint: "as from GNSS; used under the control datum";
    forget_centre: "Observe this projection centre no more";
    observe: "Observe";
    datum: "Datum";
    datum_control: "Control points";
    datum_control_means: "The result sits in the control system, and errors of control enter the shape.";
    datum_minimal: "Minimal constraints";
    datum_minimal_means: "Seven coordinates are held: fixes position, rotation and scale only. Standard errors depend on which seven.";
    datum_free: "Free network";
    datum_free_means: "Inner constraints over all points give the smallest mean sigma; control only gives the start.";

    // Adjustment
    adjustment: "Adjustment";
    bundle_adjustment: "Bundle adjustment";
    adjust_sentence: "Orientation finds initial values, then everything is adjusted together.";
    adjusted_sentence(observations, unknowns, redundancy):
        "{observations} {observations:observation|observations}, {unknowns} unknowns, redundancy {redundancy}.";
    adjust_now: "Adjust";
    adjust_again: "Adjust again";
    adjusting: "Adjusting";
    what_is_estimated: "What is estimated";
    unknowns: "unknowns";
    orientation_of(n): "Orientation of {n} {n:photo|photos}";
    position_and_rotation: "position and rotation, estimated";
    object_points: "Object points";
    points_all(n): "{n} × 3 coordinates";
    points_with_control(n, control): "{n} × 3 coordinates, {control} of them control";
    model_brown: "Brown";
    model_opencv: "OpenCV";
    model_opencv_rational: "OpenCV, rational";
    model_opencv_fisheye: "OpenCV, fisheye";
    of_model(model, words): "{model}: {words}";
    all_estimated(free): "{free} estimated";
    all_held(held): "{held} held";
    estimated_and_held(free, held): "{free} estimated; {held} held";
    estimated: "estimated";
    initial_value: "initial value";
    observed_with: "standard error of the value as an observation; empty: not observed";
    not_observed: "none";
    from_what: "From what";
    observations: "observations";
    image_coordinates: "Image coordinates";
    median_sigma(sigma): "each weighted with its own σ, median {sigma} px";
    control_coordinates: "Control coordinates";
    iterations: "Iterations";
    logarithmic: "logarithmic";
    no_iterations: "Iterations appear here as they are computed.";
    number: "no.";
    largest_step: "largest step";
    damping: "damping";
    converged: "The step fell below its limit: converged.";
    iteration_limit: "The largest number of iterations was reached without convergence: what is shown is not a solution.";
    diverged: "No step lowered the residuals: check identities, control points and initial values.";
    stopped: "Stopped on request.";

    // Advice
    sigmas_optimistic(sigma0): "The standard errors of the image coordinates are too small by {sigma0}";
    sigmas_optimistic_body:
        "σ₀ should be 1. Something that is not modelled is left in the residuals (flatness of targets, light, lens), or the sigmas are too hopeful. Sigmas of the result include σ₀.";
    more_notes(n): "{n} {n:more measurement disagrees|more measurements disagree} with the orientation";
    what_lacks: "Warnings and advice";
    hold(name): "Hold {name}";
    lacks_control: "Give at least three control points, or choose another datum";
    lacks_control_body: "The control datum takes position, attitude and scale from known points that do not lie on one line.";
    n_control(n): "{n} control";
    n_check(n): "{n} check";
    n_distances(n): "{n} {n:distance|distances}";
    no_unit: "no unit";
    lacks_scale: "Give a distance between two points";
    lacks_scale_body: "Neither control nor a distance gives the scale: the size of the result is arbitrary.";
    seen_once(points): "Measure in a second photo: {points}";
    seen_once_body(point, photo): "Point {point} is measured in photo {photo} only. It takes no part; nothing of it is lost.";
    n_points(n): "{n} {n:point|points}";
    n_photos(n): "{n} {n:photo|photos}";
    photo_without_points(photos): "No point is measured in photo {photos}";
    photo_without_points_body:
        "It cannot be oriented and takes no part: detect targets with other options, name some by hand, or leave it out.";
    hold_or_more(name, camera): "Hold {name} of camera {camera}, or add photos that determine it";
    hold_alone_body(name, ratio): "{name} is only {ratio} times its sigma: the network does not tell it from 0.";
    hold_or_more_body(name, ratio, other):
        "{name} is only {ratio} times its sigma and moves with {other}: the network does not determine both.";
    look_at(point, photo): "Look at point {point} in photo {photo}";
    look_at_given(kind, name): "Check the {kind} {name}";
    look_at_body(n, w, alpha):
        "{n} {n:observation exceeds|observations exceed} the critical value {w} of Baarda's w at α {alpha} %. The largest is this one.";
    nothing_lacks: "Every photo is tied and every point determined";
    nothing_lacks_body: "No observation is further off than chance explains, no parameter is left undetermined.";
    c_found(camera, value): "Principal distance of camera {camera} found: {value}";
    c_assumed(camera, value): "Principal distance of camera {camera} started at {value}";
    c_body: "No value was given; this one is only the start of the adjustment.";
    photo_not_oriented(photo): "Photo {photo} could not be oriented";
    photo_no_points: "No point is measured in it: detect with other options or name points by hand.";
    photo_too_few(determined, needed):
        "Only {determined} of its points are known from other photos or control; it takes {needed}.";
    photo_disagrees(determined):
        "Its {determined} {determined:point|points} do not fit together: look for wrong names, or another camera.";
    photo_other_group(group):
        "It belongs to group {group} of photos, which shares too little with the oriented ones.";
    c_weak(camera, value): "The network hardly determines the principal distance of camera {camera} ({value})";
    c_weak_body:
        "Hold it, observe it with a standard error, or add photos that are tilted and rolled against each other.";
    c_undetermined: "undetermined";
    c_changed(camera, given, value):
        "Principal distance of camera {camera}: {given} was given, the photos say {value}";
    c_changed_body: "Another lens, zoom or picture size, most often; else look for wrong names.";
    photo_groups(n): "The photos fall into {n} groups that are not tied to each other";
    photo_groups_body(groups):
        "Measure common points or add photos between them. Only the first group is oriented: {groups}";
    photo_ambiguous(photo): "Two orientations of photo {photo} fit its known points alike";
    photo_ambiguous_body:
        "The one with the smaller residuals was taken. Measure another point outside the plane of the others.";
    point_not_determined(point): "Point {point} has no coordinates";
    point_not_measured: "It was measured in no photo.";
    point_too_few(photos): "It is measured in {photos} {photos:oriented photo|oriented photos}; it takes two.";
    point_parallel(angle): "Its rays meet at {angle}° only: measure it in a photo from another side.";
    point_behind(photo): "It would lie behind the camera of photo {photo}: look for a wrong name.";
    point_disagrees: "Its rays do not meet: look for a wrong name in one of its photos.";
    point_no_coordinates: "It is a control or check point without coordinates.";
    point_undecided(first, second):
        "As many of its rays meet in one place (photos {first}) as in another ({second}): one name for two targets. Decide which is meant.";
    measurement_disagrees(point, photo): "Point {point} in photo {photo} disagrees with the other measurements";
    measurement_disagrees_body: "A wrong name, most often. Look at it, rename or exclude it.";
    behind: "behind";

    // Questions about the input
    exchange_now(how): "Correct by {how}";
    exchanging(first, second): "exchanging {first} and {second}";
    negating(axis): "changing the sign of {axis}";
    mirrored(exchange, exchanged, given):
        "The given coordinates are mirrored: {exchange} makes them fit to {exchanged} instead of {given}";
    mirrored_body: "With the axes as given, coordinates may be wrong though every test passes.";
    mirrored_or_body(others):
        "The photos do not tell this from {others}; each gives the same form. With the axes as given, coordinates may be wrong though every test passes.";
    undecided_axes: "The given points lie in a plane: are the axes right?";
    undecided_axes_body(normal):
        "A mirrored plane fits as well. With these axes the cameras stand on the side ({normal}); if they stood on the other, two axes are exchanged or one has the wrong sign.";
    unit_of_distance(bars): "Distance {bars}: a wrong unit?";
    unit_of_control: "Control points: a wrong unit?";
    unit_of_camera(camera): "Principal distance of camera {camera}: a wrong unit?";
    unit_of_diameters: "Coordinates and target diameters: different units?";
    unit_body(ratio, nearest): "It is {ratio} times what the rest gives; the ratio of two units of length is {nearest}.";
    one_station(photos): "Photos {photos} were taken from one place";
    one_station_body: "They add no depth to each other. Points need a photo from another place.";
    one_station_all: "All photos were taken from one place";
    one_station_all_body: "They show neither depth nor principal distance. Take photos from other places.";
    field_of_view(camera, value): "Camera {camera}: a principal distance of {value} cannot be right";
    field_of_view_body: "The field of view would be impossible; the value was not used.";
    field_of_view_pixels:
        "It would be in pixels, since the camera has no pixel pitch; the value was not used. Give the pitch, or the value in pixels.";
    image_size(camera, photos): "Photos {photos} are larger than the pictures of camera {camera}";
    image_size_body(size):
        "The camera has {size} px. Take the camera of these photos, or the calibration for their size.";
    photo_resized(photo, camera): "Photo {photo} was resized against camera {camera}";
    photo_cropped(photo, camera): "Photo {photo} is cropped against camera {camera}";
    photo_reframed_body: "It was not oriented. Take the original file, or give the photo a camera of its own.";
    photo_other_distance(photo, camera): "Photo {photo} has another principal distance than camera {camera}";
    photo_other_distance_body: "Another zoom or camera. It was not oriented; give the photo a camera of its own.";

    // Results
    results: "Results";
    no_result: "There is no result yet";
    no_result_body: "Run the adjustment; its result appears here.";
    results_stale: "These results are out of date";
    changed_since: "Since the last adjustment:";
    no_number_until: "No number is shown until the network is adjusted again.";
    a_priori_one: "a priori 1";
    test_passed: "Global test passed";
    test_failed: "Global test failed";
    standard_errors_estimated(factors): "No global test: standard errors estimated, {factors}";
    times_a_priori_px(factor, px): "{factor} times the a priori {px} px";
    times_a_priori(factor): "{factor} times the a priori ones";
    and_unmodelled(factors, px): "{factors}, and {px} px that are not modelled";
    not_estimated(redundancy, needed): "not estimated: redundancy {redundancy}, needed {needed}";
    no_residuals: "not estimated: all residuals are 0";
    errors_estimated: "standard errors estimated";
    redundancy: "redundancy";
    rms_residual: "rms residual";
    all_image_coordinates: "all image coordinates";
    rms_sigma: "rms σ";
    points_one_sigma(n): "{n} {n:point|points}, 1σ";
    relative_accuracy: "relative accuracy";
    largest_dimension(length, unit): "largest dimension {length} {unit}";
    check_rms: "check points rms";
    check_points: "Check points";
    adjusted_minus_given: "adjusted minus given";
    export_csv: "Export CSV";
    camera_and_correlations(camera): "Camera {camera} and its correlations";
    value: "value";
    unit: "unit";
    rms_x: "rms x";
    rms_y: "rms y";
    rms_summary(x, y, unit, n): "rms x {x}, y {y} {unit}, {n} {n:point|points}";
    residuals: "Residuals";
    residuals_of(photo): "Residuals, photo {photo}";
    worst_observations: "Worst observations";
    baarda: "Baarda's w, α 0.1 %";
    over(limit): "over {limit}";
    verdict: "verdict";
    unchecked: "unchecked";
    other_observations: "Other observations";
    kind_of_observation: "kind";
    detectable: "detectable";
    effect: "effect";
    effect_on: "on point";

    // Changes
    change_photos_added(n): "{n} {n:photo|photos} added";
    change_shots_swapped(n): "{n} {n:shot|shots} measured in the other file";
    change_photo_removed(id): "photo {id} removed";
    change_photo_switched(id): "photo {id} excluded or included";
    change_camera_edited(id): "camera {id} changed";
    change_camera_assigned(photos, camera): "camera {camera} given to {photos} {photos:photo|photos}";
    change_detected: "targets detected";
    change_measured(photo): "a target measured in photo {photo}";
    change_named(point): "point {point} named";
    change_renamed(from, to): "point {from} renamed to {to}";
    change_moved(point, photo): "point {point} moved in photo {photo}";
    change_observation_removed(point, photo): "point {point} removed from photo {photo}";
    change_observation_switched(point, photo): "point {point} in photo {photo} excluded or included";
    change_point_removed(point): "point {point} removed";
    change_marks_taken(n): "{n} {n:mark|marks} taken";
    change_matched(n): "{n} {n:observation|observations} matched";
    change_control_taken(n): "{n} {n:control point|control points} taken";
    change_role(point): "role of point {point} changed";
    change_distance_added(from, to): "distance {from} – {to} added";
    change_distance_edited(from, to): "distance {from} – {to} changed";
    change_control_edited(point): "coordinates of point {point} changed";
    change_centre_observed(photo): "projection centre of photo {photo} observed";
    change_centre_forgotten(photo): "projection centre of photo {photo} no longer observed";
    change_distance_removed(from, to): "distance {from} – {to} removed";
    change_datum: "datum chosen";
    change_colours_taken(camera): "colours of camera {camera} taken";
    change_colours_forgotten(camera): "colours of camera {camera} removed";
    change_axes: "axes of the given coordinates exchanged";
    change_parameters(camera): "parameters of camera {camera} changed";
    change_options: "weights or search for gross errors chosen";
    change_adjusted: "adjusted";
    change_unit: "unit of length changed";
    change_unit_converted: "lengths converted to another unit";
    change_photos_attached(n): "files of {n} {n:photo|photos} attached";
    change_photos_replaced(n): "{n} {n:photo|photos} replaced";
    change_opened: "project opened";
    unmodelled: "extra image error, px";
    unmodelled_why: "added in quadrature to every σ of the image: lens, flatness of targets, light";
    target_diameter(unit): "target diameter, {unit}";
    target_diameter_why:
        "of all circular targets that state none of their own: frees their images of the eccentricity; empty for none";
    no_diameter(typed): "\"{typed}\" is no diameter: type a number above 0, or nothing.";
    gross_errors: "Gross errors";
    gross_left: "Leave everything in";
    gross_left_body: "Suspicious observations are named; you decide.";
    gross_snooping: "Data snooping";
    gross_snooping_body: "The worst observation is taken out, one a round, and taken back where it fits after all.";
    gross_huber: "Robust weights, Huber";
    gross_huber_body: "Large residuals count less; nothing is taken out.";
    gross_tukey: "Robust weights, Tukey";
    gross_tukey_body: "Beyond its limit a residual counts nothing.";
    not_used_head: "Not used";
    not_used_cell: "not used";
    not_used(parts): "Not used: {parts}.";
    show_not_used: "Show the list";
    take_back: "Take back";
    left_out_reason: "reason";
    left_of_observations(n, of): "{n} of {of} image observations";
    left_of_control(n, of): "{n} of {of} control points";
    left_of_coordinates(n): "{n} given {n:coordinate|coordinates}";
    left_of_distances(n, of): "{n} of {of} distances";
    left_of_photos(n, of): "{n} of {of} photos";
    left_of_points(n, of): "{n} of {of} object points";
    left_of_parameters(n): "{n} camera {n:parameter|parameters}";
    image_observation: "image observation";
    control_point_word: "control point";
    object_point_word: "object point";
    photo_word: "photo";
    by_orientation: "by orientation";
    by_matching: "by matching";
    by_snooping: "by data snooping";
    by_robust: "by robust weights";
    by_document: "by hand";
    by_adjustment: "by the adjustment";
    out_disagrees: "disagrees with the other observations";
    out_photo_not_oriented: "its photo is not oriented";
    out_point_not_determined: "its point is not determined";
    out_undecided: "as many observations of its point support another place: decide which are right";
    out_gross_error: "gross error";
    out_no_weight: "no weight left";
    out_disabled: "switched off";
    out_photo_disabled: "its photo is switched off";
    out_not_measured: "not measured in any photo that took part";
    gross_record: "What was done about gross errors";
    gross_removed: "taken out";
    gross_restored: "taken back";
    gross_downweighted: "weighted down";
    gross_kept: "kept: nothing else determines what it does";
    weak_distance(camera, parameter): "The photos hardly determine {parameter} of {camera}";
    weak_distance_parallel: "They look the same way: hold it or give it a σ, or take photos that converge.";
    weak_distance_body: "Hold it or give it a σ, or add photos that converge and points at different depths.";
    components: "Estimate the standard errors";
    components_why: "One factor for image coordinates, control, distances and the rest, each from its own residuals, until sigma0 is 1. Groups that too little checks keep theirs. There is no global test then.";
    given_weights: "Adjust with the given standard errors";
    components_unsettled: "The variance components came to no end";
    components_unsettled_body: "Too few observations of one kind, or gross errors among them: take those out first.";
    gross_round: "round";
    gross_action: "action";
    gross_statistic: "τ or weight";
    gross_limit: "limit";
    photo_or_kind: "photo or kind";
    gross_consequence: "along with it: one ray left";
    control_coordinate: "control coordinate";
    projection_centre: "projection centre";
    distance: "distance";
    camera_parameter: "camera parameter";
    unmodelled_again: "What is not modelled can be told more closely now";
    unmodelled_again_body: "The value was found with other weights; with these the residuals ask for this one.";
    add_unmodelled(px): "Use {px} px and readjust";
    correlated(first, second): "{first} and {second} are strongly correlated";
    correlated_body(camera): "Camera {camera}: hold one of them, or add rolled photos and depth.";
    camera_against_photos(n): "Camera and photo positions cannot be separated well in {n} {n:photo|photos}";
    camera_against_photos_body(limit, photos):
        "Correlations over {limit}. Coordinates suffer little as long as the camera is used as adjusted; take photos rotated by 90° and from different distances ({photos}).";
    low_redundancy(n): "{n} {n:observation is|observations are} hardly checked by others";
    low_redundancy_body(names): "Redundancy numbers below 0.1: an error there would stay unseen ({names}).";
    two_rays(points): "Measure in a third photo: {points}";
    two_rays_body: "With two rays an error along the epipolar line stays unseen.";
    narrow(points): "Rays meet under less than 5°: {points}";
    narrow_body: "The depth is weak: add a photo from the side.";
    behind_camera(names): "Points behind the camera that is said to see them: {names}";
    behind_camera_body: "Check these names: the solution is turned inside out there.";
    distance_unused(names): "Distances left out: {names}";
    distance_unused_body: "An end of it is not measured in two photos.";
    control_misfit(point, size, axis): "Control point {point} is {size} from where the photos see it, mainly in {axis}";
    control_misfit_body: "Check its coordinates and its name in the photos.";
    exchanged_points(a, b): "Control points {a} and {b} seem exchanged";
    exchanged_points_body: "With their coordinates exchanged they fit.";
    double_points(pairs): "Points that may be one: {pairs}";
    double_points_body: "They are nearer to each other than their standard errors tell apart: give them one name.";
    unsettled: "The search for gross errors came to no end";
    unsettled_body: "Too many observations contradict each other: look at names and control first.";
}}

declare! { experiments {
    // The pages
    experiments: "Experiments";
    experiments_words:
        "Three papers from Korea, run again: their networks simulated and adjusted here, their figures beside ours.";
    running: "Running the experiment";
    run: "Run";
    run_again: "Run again";
    open_as_project: "Open as a project";
    not_run_yet: "Run the experiment to see its figures. It takes a few seconds in the background; the page stays usable.";
    inputs_changed: "The inputs have changed since the last run: run again to see the figures that belong to them.";
    ran_in(seconds): "run in {seconds} s";
    vary: "What may be varied";
    network: "Network";
    drawing_shown: "network drawn";
    plan: "plan";
    elevation: "elevation";
    assumed: "Assumed here";
    assumed_aside: "not printed in the paper, or printed otherwise";
    ours: "ours";
    paper: "paper";
    paper_of(what): "{what}, paper";
    independent: "independent";
    difference: "difference";
    figure: "figure";
    figures: "Figures";
    no_paper_figure: "not printed";
    rows(n): "{n} rows";

    // Questions, one an experiment
    kang: "Kang & Yeu 1985";
    kang_question: "How much do more photos improve coordinates?";
    kang_source:
        "Kang, J. M. and Yeu, B. M. (1985), A Study on the 3 Dimensional Precision Analysis of Objects by means of Multiple Close Range Photogrammetry.";
    film: "Film";
    film_question: "What do fiducial marks and a distortion table make of comparator readings?";
    film_source: "The way of Kang and Yeu (1985), figures 3-2 and 3-3, on readings made up here.";
    lee_calibration: "Lee 1996, calibration";
    lee_calibration_question: "How well does a camera calibrate itself, from the pixels on?";
    lee_source:
        "Lee, J. D. (1996), Effective Application of Close-Range Photogrammetry with Digital Images in Industrial Precise Measurement.";
    lee_structure: "Lee 1996, structure";
    lee_structure_question: "What do convergent photos and a free network give?";
    sensor: "Sensor or JPEG";
    sensor_question: "What do centres and coordinates lose between the sensor and a camera's JPEG?";
    sensor_source: "An experiment of our own: one exposure each, rendered through lens and colour filters with the noise of its photons, then taken through the steps of a camera. Six photos, self-calibrated in a free network, against the true centres and coordinates.";
    step_sites: "RAW";
    step_demosaiced: "demosaiced";
    step_sharpened: "sharpened";
    step_toned: "toned";
    step_jpeg_92: "JPEG 92";
    step_jpeg_75: "JPEG 75";
    step_of_camera: "measured on";
    error_over_sigma: "error / σ";
    object_rms: "coordinate errors, rms";
    object_sigma: "stated σ, rms";
    over_sites: "over RAW";
    visible: "centres in sight";
    t_sensor_steps: "What every step costs";
    c_sensor_centres: "Errors of the centres";
    c_sensor_objects: "Errors and stated standard errors of the coordinates";
    a_sharpening(v): "Sharpening adds {v} % of the difference to the binomial mean of 3 × 3 pixels.";
    kim: "Kim, Hwang & Yun 2015";
    kim_question: "How near does a pair of photos come, from DLT to intersected points?";
    kim_source:
        "Kim, H. G., Hwang, J. S. and Yun, H. S. (2015), Accuracy Analysis of 3D Position of Close-range Photogrammetry Using Direct Linear Transformation and Self-calibration Bundle Adjustment with Additional Parameters.";

    // Plates of one's own
    plates: "Plates of your own";
    plates_words:
        "Describe camera, fiducial marks and distortion table, one a line; then take readings: photo, mark or point, x, y in the machine's millimetres.";
    plates_description: "description of camera and plates";
    plates_files: "Readings from files…";
    plates_scans: "Measured in the scans";
    plates_scans_words:
        "In scanned photos: point at marks and points under Targets, name the marks as above under Point names, then return here.";
    plates_reduced(photos, observations):
        "{photos} {photos:photo|photos} reduced, {observations} {observations:observation|observations}.";

    // Inputs
    in_distance: "object distance";
    in_mixed: "mixed distances";
    in_combination: "combination";
    in_photos: "number of photos";
    in_overlap: "overlap";
    in_network: "network of the project";
    in_datum: "datum of the project";
    in_image_sigma: "σ of image coordinates, µm";
    in_control_sigma: "σ of control coordinates, mm";
    in_pixel_noise: "noise of the pixels, % of full scale";
    in_rounds: "rounds of Monte Carlo";
    in_seed: "seed of the noise";
    in_method: "centres adjusted";
    in_left_out: "photos left out of the second run";
    left_out_hint: "numbers, separated by blanks";

    // What a name in a cell, on an axis or after a figure says
    all: "all";
    reduced: "without the photos left out";
    control: "control";
    free: "free network";
    observed: "observed";
    unknown: "unknown";
    yes: "yes";
    no: "no";
    greatest: "greatest";
    least: "least";
    mean: "mean";
    standard_deviation: "standard deviation";
    rms: "rms";
    similarity: "similarity";
    affine: "affine";
    projective: "projective";
    similarity_corrected: "similarity, lens corrected";
    affine_corrected: "affine, lens corrected";
    projective_corrected: "projective, lens corrected";
    field: "test field";
    planes: "two planes";
    all_photos: "all photos";

    // What identifiers of tables and charts say
    t_single: "60 networks at one distance";
    t_mixed: "16 networks of mixed distances";
    t_improvement: "Fall of M₀ and Mₛ against two photos";
    t_pairwise: "Models pair by pair (coplanarity) and the bundle";
    t_fiducials: "Residuals at the fiducial marks";
    t_transformations: "Parameters of the transformations";
    t_distortion: "Distortion table and odd polynomial";
    t_reductions: "What the bundle makes of each reduction";
    t_photos: "Residuals photo by photo";
    t_parameters: "Camera parameters";
    t_estimators: "Centres against the truth, best first";
    t_standard_errors: "Standard errors";
    t_free_gain: "Gain of the free network";
    t_check_points: "Check points, photogrammetry minus survey";
    t_statistics: "Statistics of the differences";
    t_orientation: "Exterior orientation";
    t_interior: "Interior orientation";
    c_errors(n): "Standard errors with {n} {n:photo|photos}";
    c_improvement(d): "Improvement at {d} m";
    c_mixed: "Standard errors of mixed distances";
    c_pairwise: "Errors with 3 photos: pair by pair and bundle";
    c_distortion: "Radial distortion";
    c_distortion_error: "Radial distortion, ours minus planted";
    c_way(axis, photo): "{axis} of photo {photo} over the iterations";

    // Axes, columns, lines, figures
    photo: "photo";
    point: "point";
    points: "points";
    photos: "photos";
    count: "compared";
    found: "found";
    overlap_type: "type (overlap)";
    standard_error: "standard error";
    rms_error: "rms error";
    improvement: "improvement";
    distance: "distance";
    observations: "observations m";
    unknowns: "unknowns n";
    equations: "equations";
    datum: "datum";
    parameters: "additional parameters";
    relative: "relative accuracy";
    relative_column: "relative accuracy 1 :";
    method: "method";
    largest: "largest";
    mark: "mark";
    kind: "transformation";
    parameter: "parameter";
    value: "value";
    radius: "radius";
    distortion: "distortion";
    table: "table";
    polynomial: "polynomial";
    residual: "residual";
    corrected: "lens corrected";
    bundle_sigma0: "σ₀ of the bundle";
    marks_sigma0: "σ₀ of the marks";
    planted: "planted (the paper's)";
    error: "error";
    element: "element";
    dlt: "DLT";
    bundle: "bundle";
    statistic: "statistic";
    total: "total";
    iteration: "iteration";
    iterations: "iterations until nothing moves by 0.1 mm";
    check_points: "check points";
    base_fall(base): "fall of M₀ with B/D from 0.2 to {base}";
    fall_of(what): "fall of {what}";
    m0_mean(n): "{n} {n:photo|photos} against 2, mean fall of M₀";
    m0_up_to(n): "{n} {n:photo|photos} against 2, greatest fall of M₀";
    m0_least: "least fall of M₀ over types";
    m0_greatest: "greatest fall of M₀ over types";
    monte_carlo(axis): "Monte Carlo scatter against S{axis}";
    residual_axis(axis): "residual {axis}";
    rms_sigma(axis): "rms σ{axis}";
    error_of(what): "error of {what} in its σ";
    gain_of(axis): "gain of the free network in {axis}";
    centre_rms: "centre errors, rms";
    distortion_sigma0: "σ₀ of the polynomial";
    pair_unaided: "pairs, best fit, one draw";
    pair_draws: "pairs, axes parallel, 4 draws";
    bundle_draws: "bundle, 4 draws";
    pair_of(axis): "pairs {axis}";
    bundle_of(axis): "bundle {axis}";
    pair_rms_draws: "pairs rms, 4 draws";
    bundle_rms_draws: "bundle rms, 4 draws";
    pair_unaided_rms: "pairs best fit rms";
    pair_unaided_rms_draws: "pairs best fit rms, 4 draws";
    reduced_of(what): "{what}, photos left out";

    // Assumptions, as sentences
    a_base_line_centre: "The base line's centre faces the mean of the points: the paper does not print where it lies.";
    a_overall_means:
        "\"About 15, 35 and up to 50 %\" is read over the distances of the paper's figures 4-6 to 4-9, 1.4 to 4.0 m: the means of 3 and 4 photos, the greatest fall with 5. At 7.0 m more photos gain more.";
    a_pairwise:
        "The paper's models formed pair by pair had random errors that did not follow the distance. With random image errors alone ours grow with the distance like the bundle's: the method by itself is not irregular. It becomes so where the second orientation of a shallow object is taken for the first.";
    a_sigma0_draws(n): "S₀ is the root mean square of {n} draws of the noise, each network's own, with its σ; the paper has one set of readings.";
    a_gain_misprint(ours, paper): "The paper's table 5 prints {paper} % for Z in network I, its tables 3 and 4 give {ours} %: taken for a misprint, and compared with {ours} %.";
    a_readings: "The readings are made up: plates of the usual kind, read to the σ above. The paper prints none.";
    a_distortion: "The distortion table is made up, of the usual size: the paper shows it as a drawing only.";
    a_film_along(v): "The film shrank to {v} along its run.";
    a_film_across(v): "The film shrank to {v} across it.";
    a_station_distance(v, paper):
        "Stations {v} mm away; the paper says about {paper} mm, from where this camera sees 1.9 × 1.3 m of the 2.0 × 1.5 m field and fewer targets than the 100 to 119 a photo of its table 1. Farther away it sees more of them, though still not as many.";
    a_field_depth(v): "Targets at depths over {v} mm: the paper says \"three-dimensional\" and no more.";
    a_station_directions: "Stations on an arc at ±10°, ±30°, ±50°: the paper draws them without figures.";
    a_psf(v): "Lens blur of {v} px (standard deviation).";
    a_pixel_noise(v): "Pixel noise of {v} % of full scale, constant and by photons.";
    a_centroid: "Intensity centroids are adjusted, the paper's better weighting; other centres can be chosen above.";
    a_base_distance(v, paper):
        "Base line {v} mm from the wall; the paper says about {paper} mm, from where this camera sees 3.7 × 2.5 m of the 6.3 × 3.5 m wall. At 7.4 m network I has the paper's 374 equations, but the photos of II miss the upper and lower rows. Standard errors grow with the distance.";
    a_ray_on_wall(v):
        "Ours are two to three times the paper's. A ray is uncertain by {v} mm on the wall here, and six of them leave 0.4 of that at best. With 3 µm the paper's 0.273 mm of network I takes 21 rays, or a camera at 4.6 m, from where a photo holds less than a third of the wall; its 374 equations ask for 30 of the 38 targets in every photo. Its standard errors and its equations are not of one geometry: compare order and gains, not sizes.";
    a_outer(v):
        "Outer stations of network I {v} mm from the middle: not printed. From 5 000 to 7 500 mm the order III, I, II in depth is the same.";
    a_relief(v): "Targets on pillars stand {v} mm before the wall: not printed.";
    a_observed:
        "The additional parameters are observed with the sigmas of the first experiment's calibration; in the paper they are unknown. The table has both: in network II four control points then add to the calibration what the free datum does without.";
    a_principal_distance(v): "Principal distance {v} mm: the paper prints none. The image scale is then about 1 : 1 100.";
    a_survey(v):
        "Surveyed coordinates are off by {v} mm (1σ): better than the total station's 2 mm + 2 ppm, as within one room and from one set-up.";
    a_diameter(v): "Targets of {v} mm.";
    a_control_places:
        "The 65 control points lie on two planes through the check points: the paper prints the 15 check points only.";
}}

declare! { object {
    open_object: "Object in 3-D";
    object: "Object";
    sentence(points, photos, features): "{points} points, {photos} photos, {features} {features:feature|features}, from this adjustment.";
    save_picture: "Save picture…";
    seen_from: "Seen from";
    side_home: "Home";
    side_top: "Top";
    side_front: "Front";
    side_right: "Right";
    side_along: "Along the axis";
    perspective: "Perspective";
    show_names: "Names";
    show_rays: "Rays";
    show_ellipsoids: "Ellipsoids";
    show_deviations: "Deviations";
    show_grid: "Grid";
    features: "Features";
    how_to_move: "Drag turns, right drag or two fingers move, wheel zooms; arrows, + and − do too.";
    space_label: "The object in space. Arrow keys turn, with Shift they move, plus and minus zoom, 1 to 4 are the standard views, F fits, P changes the perspective.";
    no_graphics(detail): "The view in space cannot be shown here ({detail}): switch on hardware acceleration or WebGL in the browser. The object from above instead:";
    graphics_lost: "the graphics of this page were taken away";
    caption(points, photos, factor, unit): "{points} points, {photos} photos; error ellipsoids 1σ, {factor} times; lengths in {unit}";
    overview_label: "The object with its photos, seen obliquely from above";
    every_nth_point(n): "Of the unknown points one in {n} is drawn.";
    kind_distance: "distance";
    kind_angle: "angle";
    kind_line: "line";
    kind_plane: "plane";
    kind_circle: "circle";
    kind_sphere: "sphere";
    kind_cylinder: "cylinder";
    kind_deviations: "deviations";
    system_automatic: "automatic, in the object's plane";
    system_plane_line_point: "3-2-1 by plane, line, point";
    system_best_fit: "best fit to given coordinates";
    chosen_points: "Points";
    chosen_points_hint: "201-212, 7: or click, with Shift for more";
    new_feature: "New";
    new_system: "New system";
    unknown_points(names): "There is no point {names}.";
    from_feature(name): "from {name}";
    n_points(n): "{n} {n:point|points}";
    quantity_distance: "length";
    quantity_angle: "angle";
    quantity_diameter: "diameter";
    quantity_rms: "form, rms";
    no_features: "Nothing is measured yet. Choose points in the view or by their names, then what they make.";
    hardly_forms(kind, rms, percent): "these points hardly form a {kind}: rms {rms}, {percent} % of their extent";
    weakly_determined(percent): "so weakly determined ({percent} %) that it has no standard errors";
    missing_points(names): "not determined here: {names}";
    deviation: "deviation";
    feature_name: "Name of the feature";
    system_name: "Name of the coordinate system";
    with_scale: "with scale";
    change_system_scaled(id): "scale of coordinate system {id}";
    remove: "Remove";
    position: "Position";
    direction: "Direction";
    form: "Form";
    range(rms, low, high): "rms {rms}, {low} to {high}";
    systems: "Coordinate systems";
    fit_sigma(sigma, unit): "σ₀ {sigma} {unit}";
    lines: "Lines";
    join: "join";
    part: "part";
    layer: "Layer";
    removed_too(n): "{n} {n:feature that was built on it is|features that were built on it are} removed too.";
    name_taken: "A feature needs a name that no other has.";
    lacks_points(n): "Choose {n} points or more first: click them with Shift, or type their names.";
    lacks_ends: "A distance has two ends: choose two points, two features (with Shift), or one of each.";
    lacks_angle: "An angle is between two chosen features with a direction, or at the second of three chosen points.";
    lacks_feature: "Choose the one feature that points deviate from, or give points coordinates under control; chosen points too, if not all are meant.";
    lacks_plane_line_point: "Choose a plane and a line in the list (with Shift) and one point, where X is 0.";
    lacks_given: "A best fit needs three points with given coordinates: give them under control.";
    change_made(name): "feature {name} made";
    change_removed(name): "feature {name} removed";
    change_renamed(from, to): "feature {from} renamed to {to}";
    change_layer(name): "colour of layer {name}";
    layer_colour(name): "Colour of layer {name}";
    full_screen: "Full screen";
    change_lines: "lines drawn";
}}

declare! { errors {
    recognised(kind): "this is a {kind} file, which is not read here: convert it to JPEG, PNG or TIFF";
    raw_unread(kind): "this is a {kind} file, which is not read here: convert it to DNG (Adobe DNG Converter, dnglab), which keeps the sensor's samples";
    decoder_missing(format, message): "the decoder of {format} files could not be loaded ({message}): it is fetched when the first such file comes, which needs the network once";
    no_picture: "not a picture that is read here: JPEG, HEIC, camera RAW, PNG, TIFF or BMP is expected";
    broken(detail): "the picture cannot be decoded ({detail}): copy it again from the camera";
    size(width, height, limit): "the picture has {width} × {height} pixels; from 1 to {limit} pixels are worked on";
    unknown(kind, name): "there is no {kind} \"{name}\"";
    duplicate(kind, name): "the {kind} \"{name}\" occurs twice: identifiers are unique";
    empty(what): "the project has no {what} to work on";
    initial_values(things): "initial values are missing for {things}";
    not_solved(causes): "the network cannot be solved: {causes}";
    control_disagrees_all(disagreeing):
        "control points {disagreeing} do not fit the photos and each other, and no others do: at least four must agree. Check coordinates, axes, unit and names; two may be exchanged";
    control_disagrees(disagreeing, n, agreeing):
        "control points {disagreeing} do not fit the photos and the other control points; {n} do ({agreeing}): at least four, and half of all, must agree. Check coordinates, axes, unit and names";
    stopped: "stopped on request";
    and_more(names, more): "{names} and {more} more";
    no_datum(missing):
        "{missing} of the 7 datum parameters (position, attitude, scale) are not fixed: add control points or a distance, or choose the minimal or the free datum";
    too_few_rays(points): "too few rays for point {points}: measure it in a second photo, give it coordinates or exclude it";
    photo_undetermined(photos):
        "too few points in photo {photos}: measure at least three well-spread points that other photos or the control determine, or exclude the photo";
    not_tied(groups): "groups of photos are not tied to each other ({groups}): measure common points";
    parameter_undetermined(camera, parameters):
        "camera {camera}: the network does not determine {parameters}: hold it, observe it with a sigma, or add convergent and rolled photos";
    combination(things): "the network does not determine a combination of {things}: hold or observe some of them, or add rays";
    all_one_station(photos): "all photos were taken from one place ({photos}): they show neither depth nor principal distance; take photos from other places, or give control points";
    kind_photo: "photo";
    kind_point: "point";
    kind_camera: "camera";
    kind_file: "file";
    kind_line(n): "line {n}";
    kind_field: "field";
    some_photos: "photos";
    some_points: "points";
    some_cameras: "cameras";
    some_parameters: "parameters";
}}

//! Texts of the start page, of projects and of what this browser keeps.

use super::{English, choose};
use crate::i18n::declare;

declare! { projects {
    // Start
    formats: "JPEG, HEIC, RAW, PNG, TIFF and BMP, 8 or 16 bit. RAW is measured on the sensor's own samples.";
    choose_photos: "Choose photos…";

    // Project
    project_name: "Project name";
    saved_at(clock): "saved {clock}";
    saved_without_photos(clock, n): "saved {clock}, without {n} {n:photo|photos}";
    changed_after(clock): "changed since {clock}";
    save: "Download project file";
    save_all: "Download with photos";
    save_hint: "Download the project file without the photos";
    save_all_hint: "Download the project file including the original photos; photos may contain the place where they were taken (GPS)";
    photos_carry_places: "The file contains the original photos, which may contain the place where they were taken (GPS).";
    save_with_photos: "Download the project file with the photos";
    saving: "Saving";
    cannot_save(detail): "The file could not be saved: {detail}";
    open_project: "Open project…";
    opening_project: "Opening the project";
    open_sample: "Open the sample project";
    sample_words: "A panel with coded and plain targets in computer-generated photos. Opens adjusted in one click.";
    sample_name: "Sample";
    opening_sample: "Rendering, measuring and adjusting the sample";
    busy: "Wait for the running computation to end, or cancel it first.";
    waits_at_identities(file): "{file} contains image measurements. Import them under Point names.";
    waits_at_control(file): "{file} contains control points. Import them under Control, scale.";
    marks_or_control(file): "{file} can be read as image measurements (photo, point, u, v) or as control points (id, X, Y, Z). Which is it?";
    is_empty: "the file is empty";
    file_empty(file): "{file}: the file is empty.";
    is_no_list: "it contains neither image measurements (photo, point, u, v) nor control points (id, X, Y, Z) nor distances between known points (from, to, length)";
    unsaved_here: "This project has changes that are not saved.";
    unsaved_in(name): "{name} has changes that are not saved.";
    save_first: "Download with photos, then open";
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
    not_a_number(typed): "\"{typed}\" is not a number: type one such as -0.0034.";
    ambiguous_number(typed, decimal, thousands):
        "\"{typed}\" is ambiguous: {decimal} with a decimal comma, {thousands} with a thousands separator. Type one of the two.";
    ambiguous_short: "A comma before three digits is ambiguous: type 1.234 or 1234.";

    // What this browser keeps
    recent_projects: "Recent projects";
    on_this_computer: "stored on this computer";
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
    open_elsewhere: "This project is open in another window. Changes made there appear here. To work here, take it over.";
    take_over: "Take over";
    reads_along: "Read-only: the project is open in another window. Take it over to change it.";
    other_is_kept(name): "{name} is stored on this computer; open it from the start page.";
    held_elsewhere: "The project is open in another window. Do this there, or close that window first.";
    kept_as_copy(name, copy): "Another window took {name} over before the last changes here were stored. They are stored as a separate project, {copy}.";
    storage_ended: "the storage of this browser cannot be restarted";
    list_unreadable(detail): "The list of projects could not be read ({detail}). The projects are still stored: reload the page, or close its other windows.";
    unreadable_project: "Project that cannot be read";
    journal_mended: "One bit of this stored project had changed. It was repaired; no data are lost. The damaged file can be downloaded from the start page.";
    journal_damaged(n): "This stored project was damaged. The newest state that can be read is open; {n} newer {n:state|states} and the undo history are lost. The damaged file can be downloaded from the start page.";
    journal_end_damaged: "The end of this stored project was damaged: the last change is lost. The damaged file can be downloaded from the start page.";
    journal_to_be_opened: "This stored project is damaged. Open it first: the readable part is then stored again.";
    download_damaged: "Download damaged file";
    wipe: "Delete everything stored by this page…";
    licences: "Licences of the software in this page";
    wipe_question: "Delete all projects with their photos, the equipment, the preferences and the offline copy of this page from this browser? This cannot be undone.";
    wipe_now: "Delete everything";
    gone_for_good: "This project is no longer stored in this browser.";
    deleted_projects: "Deleted projects";
    deleted_for_a_day: "kept for a day";
    put_back: "Put back";
    keeps_nothing: "This browser stores nothing here. Download the project file before you close the page.";
    storage_full: "The storage of this computer is full: the last changes exist only in this page. Download the project file, or delete projects you no longer need.";
    not_kept(detail): "The last changes could not be stored and exist only in this page ({detail}). Download the project file.";
    photos_not_copied(n, detail):
        "{n} {n:photo is|photos are} not copied into the browser's storage ({detail}). They are needed again when the project is reopened, unless you download it with photos.";
    no_room: "storage full";
    kept_unreadable(detail): "The stored project could not be read ({detail}). Nothing was deleted. If it is damaged, the start page offers the damaged file for download.";
    kept_by_newer(version): "A newer version of Sightline stored this project (format {version}). Reload the page to get that version.";
    storage_cleared(n): "The browser has cleared its storage: {n} {n:project is|projects are} gone from this list. Open them from their downloaded files.";
    cleared_under_page: "The browser cleared its storage while this page was open. This project is stored again with its photos; other projects are lost. Download the project file as well: the browser may clear its storage again.";
    cleared_with_photos(n): "The browser cleared its storage while this page was open. This project is stored again; {n} {n:photo is|photos are} lost and must be dropped on the page again. Download the project file as well: the browser may clear its storage again.";
    held_by_windows: "The browser cleared its storage, and another window of this page still holds its files: close the other windows. Until then the project exists only in this page; download the project file.";
    space_used(used, all): "{used} of {all} used";
    lasts: "kept when space runs short";
    may_be_cleared: "the browser may clear it when space runs short";
    part_did_not_come: "This part of the page could not be loaded. Check the network connection.";
    try_again: "Try again";
    no_network: "No network. Everything on this page works without it.";
    no_network_nor_copy: "No network. What is open works, but the page cannot be loaded again without a network.";
    needs_network: "the page needs a network to load";
    another_build: "The server now has another version of Sightline, and missing parts of this version cannot be loaded. Reload the page; projects are kept.";
    reload_page: "Reload";
    not_on_clipboard: "The browser did not allow copying to the clipboard. Select the cells and copy them with the keyboard, or export the table.";
    update_ready: "A new version of Sightline is available. Projects are kept.";
    take_update: "Reload to update";
} }

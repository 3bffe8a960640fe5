//! The texts: English and Korean side by side. Labels are noun phrases, advice is full sentences.

use super::texts;
pub use super::weights::*;

// Shell
texts! {
    start_page: "Sightline, start", "Sightline, 시작";
    no_project: "no project open", "열린 프로젝트 없음";
    not_saved: "not saved yet", "아직 저장 안 됨";
    steps: "Steps", "단계";
    undo: "Undo", "실행 취소";
    redo: "Redo", "다시 실행";
    switch_language: "Language: switch to Korean", "언어: 영어로 바꾸기";
    other_language: "한국어", "English";
    switch_theme: "Theme: switch", "화면 색: 바꾸기";
    theme_light: "Light", "밝게";
    theme_dark: "Dark", "어둡게";
    theme_sun: "Sun", "야외";
    dismiss: "Dismiss", "닫기";
    cancel: "Cancel", "취소";
    done_of(done, total): "{done} of {total}", "{done} / {total}";
    version(version): "Version {version}", "버전 {version}";
    units(unit): "{unit}, degrees, sigma level 1σ", "{unit}, 도, 표준오차 1σ";
    in_photos(n) [photo = n "photo" "photos"]: "in {n} {photo}", "사진 {n}매";
    worker_lost(detail): "The computation broke off and its worker was replaced ({detail}). Nothing was lost; try again, with fewer or smaller photos if memory ran out.",
        "계산이 중단되어 작업자를 교체했습니다({detail}). 잃은 자료는 없습니다. 다시 시도하고, 메모리가 부족하면 사진 수나 크기를 줄이십시오.";
}

// Start
texts! {
    drop_here: "Drop photos or a project anywhere on this page", "사진이나 프로젝트를 이 페이지 아무 곳에나 놓으십시오";
    formats: "JPEG, PNG and TIFF, 8 or 16 bit. They stay on this computer.", "JPEG, PNG, TIFF, 8·16비트. 파일은 이 컴퓨터를 떠나지 않습니다.";
    choose_photos: "Choose photos…", "사진 고르기…";
    heic_and_raw: "HEIC and RAW are recognised; the message says how to convert them.", "HEIC와 RAW는 인식하여 변환 방법을 안내합니다.";
}

// Photos and cameras
texts! {
    photos: "Photos", "사진";
    photos_sentence(photos, cameras) [photo = photos "photo" "photos", camera = cameras "camera" "cameras"]: "{photos} {photo}, {cameras} {camera}. Photos of the same make, model, size and focal length share a camera.",
        "사진 {photos}매, 카메라 {cameras}대. 제조사·모델·크기·초점거리가 같은 사진은 카메라를 공유합니다.";
    no_photos_yet: "There is no photo yet: drop some anywhere on this page.", "아직 사진이 없습니다. 이 페이지 아무 곳에나 사진을 놓으십시오.";
    add_photos: "Add photos…", "사진 추가…";
    on_to_targets: "Targets", "표적";
    opening_photos: "Opening photos", "사진 여는 중";
    photo_count(n) [photo = n "photo" "photos"]: "{n} {photo}", "사진 {n}매";
    photo_failed(photo, reason): "Photo {photo}: {reason}", "사진 {photo}: {reason}";
    no_photo_files: "No photo file is here: drop the photos of this project to work on them.", "사진 파일이 없습니다. 이 프로젝트의 사진을 놓으십시오.";
    photo_file_missing(file): "The file {file} is not here. Drop it on this page to see it.", "{file} 파일이 없습니다. 보려면 이 페이지에 놓으십시오.";
    not_taken: "Not taken", "받지 않은 파일";
    duplicate_of(file): "the same content as {file}, which is here already", "이미 있는 {file} 파일과 내용이 같습니다";
    unreadable(detail): "the browser could not read the file: {detail}", "브라우저가 파일을 읽지 못했습니다: {detail}";
    cameras: "Cameras", "카메라";
    camera: "Camera", "카메라";
    camera_named(name): "Camera {name}", "카메라 {name}";
    camera_of_their_own: "a camera of their own", "따로 새 카메라";
    picked_photos(n) [photo = n "photo" "photos"]: "{n} {photo} chosen", "고른 사진 {n}매";
    take_part: "take part in the adjustment", "조정에 포함";
    remove_from_project: "Remove from the project", "프로젝트에서 빼기";
    make_and_model: "make, model", "제조사, 모델";
    focal_length: "focal length", "초점거리";
    film_equivalent(mm): "{mm} mm on 35 mm film", "35 mm 환산 {mm} mm";
    not_in_exif: "not in EXIF", "EXIF에 없음";
    name: "name", "이름";
    name_taken(name): "The name \"{name}\" is empty or in use: names are unique.", "이름 \"{name}\" 은(는) 비었거나 이미 쓰고 있습니다. 이름은 서로 달라야 합니다.";
    not_a_length(typed): "\"{typed}\" is no positive number: type one such as 3.19.", "\"{typed}\" 은(는) 양수가 아닙니다. 3.19와 같이 입력하십시오.";
    pixel_pitch: "pixel pitch", "화소 크기";
    pitch_um(um): "pitch {um} µm", "화소 크기 {um} µm";
    pitch_unknown: "pitch unknown, in pixels", "화소 크기 미상, 픽셀 단위";
    pitch_hint: "Without a pixel pitch photo coordinates are in pixels; the object points are the same either way.",
        "화소 크기를 모르면 사진좌표는 픽셀 단위입니다. 대상점 좌표는 어느 쪽이든 같습니다.";
    principal_distance: "principal distance, initial", "주점거리 초기값";
    unknown: "unknown", "미상";
}

// Photo view
texts! {
    photo_view(photo): "Photo {photo}", "사진 {photo}";
    fit: "Fit", "맞춤";
    loupe: "loupe", "확대경";
    legend_measured: "measured", "측정";
    legend_selected: "selected", "선택";
    legend_doubtful: "doubtful", "의심";
    legend_excluded: "excluded", "제외";
}

// Targets
texts! {
    targets: "Targets", "표적";
    target: "Target", "표적";
    targets_none_yet: "Bright and dark circular targets are found, measured and, where they carry a ring code, named.",
        "밝거나 어두운 원형 표적을 찾아 측정하고, 링 코드가 있으면 이름을 붙입니다.";
    targets_sentence(targets, coded, photos) [target = targets "target" "targets", photo = photos "photo" "photos"]: "{targets} {target} in {photos} {photo}, {coded} of them coded.", "사진 {photos}매에서 표적 {targets}개, 그중 코드 표적 {coded}개.";
    targets_coded(targets, coded) [target = targets "target" "targets"]: "{targets} {target}, {coded} coded", "표적 {targets}개, 코드 {coded}개";
    detect: "Detect targets", "표적 검출";
    detect_again: "Detect again", "다시 검출";
    detecting: "Detecting", "표적 검출 중";
    polarity: "targets", "표적 밝기";
    polarity_both: "bright and dark", "밝음과 어두움";
    polarity_bright: "bright on dark", "어두운 바탕에 밝음";
    polarity_dark: "dark on bright", "밝은 바탕에 어두움";
    channel: "channel", "채널";
    channel_grey: "grey", "회색조";
    channel_red: "red", "빨강";
    channel_green: "green", "초록";
    channel_blue: "blue", "파랑";
    codes: "ring codes", "링 코드";
    codes_auto: "automatic", "자동";
    codes_none: "none", "없음";
    method: "method", "방법";
    method_least_squares: "least squares", "최소제곱 정합";
    method_ellipse: "ellipse on edges", "경계 타원 적합";
    method_intensity: "intensity centroid", "밝기 중심";
    method_gradient: "gradient centroid", "기울기 중심";
    diameter: "diameter", "지름";
    diameter_from: "smallest diameter in pixels", "최소 지름, 픽셀";
    diameter_to: "largest diameter in pixels", "최대 지름, 픽셀";
    click_a_target: "Click a target in the photo to see its centre and sigma.", "사진의 표적을 누르면 중심과 표준오차를 보입니다.";
    full_axes: "full axes", "장축·단축";
    rotation: "rotation", "회전";
    contrast: "contrast", "대비";
    edge_width: "edge width", "경계 폭";
    rejected_here: "Rejected in this photo", "이 사진에서 기각";
    reason_too_small: "too small", "너무 작음";
    reason_too_large: "too large", "너무 큼";
    reason_not_an_ellipse: "not an ellipse", "타원이 아님";
    reason_too_flat: "too flat", "너무 납작함";
    reason_low_contrast: "low contrast", "대비 부족";
    reason_touching: "touching another", "다른 것과 붙음";
    reason_saturated: "saturated", "포화";
    reason_at_border: "at the border", "사진 가장자리";
    reason_occluded: "hidden", "가려짐";
    reason_code_ring: "part of a code ring", "코드 링의 일부";
    reason_no_fit: "no fit", "적합 실패";
}

/// A point's role.
pub fn role_word(role: sightline::project::Role) -> &'static str {
    match role {
        sightline::project::Role::Tie => role_tie(),
        sightline::project::Role::Control => role_control(),
        sightline::project::Role::Check => role_check(),
    }
}

// Project
texts! {
    project_name: "Project name", "프로젝트 이름";
    saved_at(clock): "saved {clock}", "{clock} 저장됨";
    changed_after(clock): "changed since {clock}", "{clock} 이후 변경됨";
    save: "Save", "저장";
    save_all: "Save with photos", "사진과 함께 저장";
    save_hint: "Save the project file without the photos", "사진 없이 프로젝트 파일 저장";
    save_with_photos: "Save the project file with the photos in it", "사진을 포함하여 프로젝트 파일 저장";
    saving: "Saving", "저장 중";
    cannot_save(detail): "The file could not be saved: {detail}", "파일을 저장하지 못했습니다: {detail}";
    open_project: "Open project…", "프로젝트 열기…";
    opening_project: "Opening the project", "프로젝트 여는 중";
    open_sample: "Open the sample project", "예제 프로젝트 열기";
    sample_words: "A panel with coded and plain targets, photographed by the engine itself. Opens adjusted in one click.",
        "엔진이 스스로 촬영한, 코드 표적과 일반 표적이 있는 패널. 한 번 눌러 조정된 상태로 엽니다.";
    sample_name: "Sample", "예제";
    opening_sample: "Rendering, measuring and adjusting the sample", "예제 촬영·측정·조정 중";
    busy: "Wait for the work under way to end, or cancel it first.", "진행 중인 작업이 끝날 때까지 기다리거나 먼저 취소하십시오.";
    which_text(file): "{file} is a list. Drop it on the step it belongs to: marks under Identities, control points under Control, scale.",
        "{file} 은(는) 목록 파일입니다. 해당 단계에 놓으십시오. 측정점은 점 식별, 기준점은 기준점·축척 단계입니다.";
    undo_this(what): "Undo: {what}", "실행 취소: {what}";
    redo_this(what): "Redo: {what}", "다시 실행: {what}";
    out_of_date: "out of date", "갱신 필요";
    n_iterations(n): "{n} iter.", "{n}회";
    photos_and_targets(done, total, targets) [target = targets "target" "targets"]: "photo {done} of {total} · {targets} {target}", "사진 {done}/{total} · 표적 {targets}개";
    iteration_of(done, total): "iteration {done} of at most {total}", "반복 {done} / 최대 {total}";
    copy: "Copy", "복사";
    show: "Show", "보기";
    discard: "Discard", "버리기";
    found_by_orientation: "unknown: found", "미상: 자동 추정";
    not_a_number(typed): "\"{typed}\" is no number: type one such as -0.0034.", "\"{typed}\" 은(는) 수가 아닙니다. -0.0034와 같이 입력하십시오.";
}

// Identities
texts! {
    identities: "Identities", "점 식별";
    identities_sentence(named, points, single) [observation = named "observation" "observations", point = points "point" "points", once = single "point" "points"]: "{named} {observation} of {points} {point}; {single} {once} seen only once.",
        "점 {points}개에 관측 {named}개. 한 사진에만 있는 점 {single}개.";
    open_marks: "Open marks…", "측정점 파일 열기…";
    match_uncoded: "Match uncoded targets", "비코드 표적 정합";
    matching: "Matching", "정합 중";
    matched(found, doubtful) [observation = found "observation" "observations", doubt = doubtful "target is doubtful and was" "targets are doubtful and were"]: "{found} {observation} of uncoded targets matched; {doubtful} {doubt} left without a name.",
        "비코드 표적 관측 {found}개를 정합했습니다. 의심스러운 표적 {doubtful}개는 이름 없이 두었습니다.";
    control: "Control", "기준점";
    id: "id", "점번호";
    rays: "rays", "광선";
    role: "role", "구분";
    role_tie: "tie", "결합점";
    role_control: "control", "기준점";
    role_check: "check", "검사점";
    doubt: "doubt", "의심 사유";
    doubt_duplicate(photo): "code read twice in photo {photo}", "사진 {photo}에서 코드가 두 번 읽힘";
    doubt_ambiguous(photo): "fits more than one way in photo {photo}", "사진 {photo}에서 후보가 여럿";
    doubt_disagrees(photo): "disagrees with the other rays in photo {photo}", "사진 {photo}의 광선이 나머지와 맞지 않음";
    one_ray: "seen in one photo only", "한 사진에만 있음";
    no_ray: "not measured", "측정되지 않음";
    points: "Points", "점";
    point: "Point", "점";
    points_column: "points", "점";
    photo: "photo", "사진";
    named_of(named, targets) [target = targets "target" "targets"]: "{named} named of {targets} {target}", "표적 {targets}개 중 {named}개 식별";
    name_this_target: "Name of this target", "이 표적의 점번호";
    take_name: "Take", "적용";
    marks: "Marks", "측정점";
    snap_radius: "snap radius", "흡착 반경";
    snapped_sentence(good, all) [lie = all "mark lies" "marks lie"]: "{good} of {all} {lie} at a measured centre.", "측정점 {all}개 가운데 {good}개가 측정된 중심에 놓입니다.";
    take_marks(n): "Take {n}", "{n}개 적용";
    why_not: "not taken because", "적용하지 않는 까닭";
    unsnapped_no_detection: "no targets were detected in this photo", "이 사진에서 표적을 검출하지 않음";
    unsnapped_no_target: "no target within the radius", "반경 안에 표적 없음";
    unsnapped_contested(points): "as near to the same target as {points}", "{points}와(과) 같은 표적에 비슷하게 가까움";
    unsnapped_twice: "marked twice in this photo", "이 사진에 두 번 표시됨";
    remove_point: "Remove the point", "점 지우기";
    remove_observation: "Remove the observation", "관측 지우기";
    take_part_short: "takes part", "포함";
    placed_by_hand: "There is no target to measure here: the place itself was taken, with σ 0.5 px.", "측정할 표적이 없어 누른 위치를 σ 0.5 px로 적용했습니다.";
    both_in_photo(from, to, photo): "Photo {photo} shows both {from} and {to}: they cannot be one point.", "사진 {photo}에 {from} 점과 {to} 점이 모두 있어 한 점이 될 수 없습니다.";
}

// Control and scale
texts! {
    control_and_scale: "Control, scale", "기준점·축척";
    control_sentence(control, check, distances) [point = control "control point" "control points", check_point = check "check point" "check points", distance = distances "distance" "distances"]: "{control} {point}, {check} {check_point}, {distances} {distance}.",
        "기준점 {control}개, 검사점 {check}개, 거리 {distances}개.";
    open_control: "Open control points…", "기준점 파일 열기…";
    control_points: "Control points", "기준점";
    paste_control: "Paste rows here: id, X, Y, Z, sX, sY, sZ", "행을 붙여 넣으십시오: 점번호, X, Y, Z, sX, sY, sZ";
    pasted: "Control points, pasted", "기준점, 붙여넣기";
    rows_read(all, bad): "{all} rows read, {bad} not understood", "{all}행 중 {bad}행 해석 불가";
    take_points(n): "Take {n}", "{n}점 적용";
    measured: "measured", "측정됨";
    not_measured: "not measured in any photo", "어느 사진에서도 측정되지 않음";
    fixed: "fixed", "고정";
    distances: "Distances", "거리";
    distance_same_point: "A distance needs two different points.", "거리에는 서로 다른 두 점이 필요합니다.";
    distance_no_point: "Both ends must be points of this project.", "양 끝은 이 프로젝트의 점이어야 합니다.";
    distance_length: "The length must be a positive number.", "길이는 양수여야 합니다.";
    distance_sigma: "The standard error must be a positive number.", "표준오차는 양수여야 합니다.";
    add_distance: "Add", "추가";
    remove_distance: "Remove the distance", "거리 지우기";
    from_point: "from", "시점";
    to_point: "to", "종점";
    length: "length", "길이";
    unit_of_length: "unit of length", "길이 단위";
    datum: "Datum", "기준계";
    datum_control: "Control points", "기준점";
    datum_control_means: "The result sits in the control system, and errors of control enter the shape.", "결과가 기준점 좌표계에 놓이며, 기준점 오차가 형상에 들어갑니다.";
    datum_minimal: "Minimal constraints", "최소구속";
    datum_minimal_means: "Seven coordinates are held: no strain on the shape, but sigmas depend on which seven.", "좌표 7개만 고정합니다. 형상은 왜곡되지 않으나 표준오차는 선택한 7개에 따라 달라집니다.";
    datum_free: "Free network", "자유망";
    datum_free_means: "Inner constraints over all points give the smallest mean sigma; control only gives the start.", "전체 점의 내부구속으로 평균 표준오차가 가장 작고, 기준점은 초기값으로만 씁니다.";
}

// Adjustment
texts! {
    adjustment: "Adjustment", "광속조정";
    bundle_adjustment: "Bundle adjustment", "광속조정";
    adjust_sentence: "Orientation finds initial values, then everything is adjusted together.", "표정으로 초기값을 구한 뒤 모든 미지수를 함께 조정합니다.";
    adjusted_sentence(observations, unknowns, redundancy) [observation = observations "observation" "observations"]: "{observations} {observation}, {unknowns} unknowns, redundancy {redundancy}.", "관측값 {observations}개, 미지수 {unknowns}개, 잉여도 {redundancy}.";
    adjust_now: "Adjust", "광속조정 실행";
    adjust_again: "Adjust again", "다시 조정";
    adjusting: "Adjusting", "조정 중";
    what_is_estimated: "What is estimated", "무엇을 추정하는가";
    unknowns: "unknowns", "미지수";
    orientation_of(n) [photo = n "photo" "photos"]: "Orientation of {n} {photo}", "사진 {n}매의 외부표정요소";
    position_and_rotation: "position and rotation, estimated", "위치와 회전, 추정";
    object_points: "Object points", "대상점";
    points_all(n): "{n} × 3 coordinates", "{n} × 3 좌표";
    points_with_control(n, control): "{n} × 3 coordinates, {control} of them control", "{n} × 3 좌표, 그중 기준점 {control}개";
    all_estimated(free): "{free} estimated", "{free} 추정";
    all_held(held): "{held} held", "{held} 고정";
    estimated_and_held(free, held): "{free} estimated; {held} held", "{free} 추정, {held} 고정";
    estimated: "estimated", "추정";
    initial_value: "initial value", "초기값";
    from_what: "From what", "무엇으로부터";
    observations: "observations", "관측값";
    image_coordinates: "Image coordinates", "사진좌표";
    median_sigma(sigma): "each weighted with its own σ, median {sigma} px", "각 σ로 가중, 중앙값 {sigma} px";
    control_coordinates: "Control coordinates", "기준점 좌표";
    iterations: "Iterations", "반복";
    logarithmic: "logarithmic", "로그 눈금";
    no_iterations: "Iterations appear here as they are computed.", "반복이 계산되는 대로 여기에 나타납니다.";
    number: "no.", "회";
    largest_step: "largest step", "최대 보정량";
    damping: "damping", "감쇠";
    converged: "The step fell below its limit: converged.", "보정량이 한계 미만으로 수렴했습니다.";
    iteration_limit: "The largest number of iterations was reached without convergence: what is shown is not a solution.", "최대 반복 횟수에 이르렀으나 수렴하지 않았습니다. 표시된 값은 해가 아닙니다.";
    diverged: "No step lowered the residuals: check identities, control points and initial values.", "잔차를 줄이는 보정이 없었습니다. 점 식별, 기준점, 초기값을 확인하십시오.";
    stopped: "Stopped on request.", "요청에 따라 중지했습니다.";
}

// Advice
texts! {
    sigmas_optimistic(sigma0): "The standard errors of the image coordinates are too small by {sigma0}", "사진좌표 표준오차가 {sigma0}배만큼 작게 주어졌습니다";
    sigmas_optimistic_body: "σ₀ should be 1. Something that is not modelled is left in the residuals (flatness of targets, light, lens), or the sigmas are too hopeful. Sigmas of the result include σ₀.", "σ₀는 1이어야 합니다. 잔차에 모형화되지 않은 영향(표적의 평탄도, 조명, 렌즈)이 남았거나 표준오차가 너무 작습니다. 결과의 표준오차에는 σ₀가 들어 있습니다.";
    more_notes(n) [more = n "more measurement disagrees" "more measurements disagree"]: "{n} {more} with the orientation", "표정과 맞지 않는 측정 {n}개 더 있음";
    what_lacks: "What the network lacks", "망에 부족한 것";
    hold(name): "Hold {name}", "{name} 고정";
    lacks_control: "Give at least three control points, or choose another datum", "기준점을 셋 이상 주거나 다른 기준계를 고르십시오";
    lacks_control_body: "The control datum takes position, attitude and scale from known points that do not lie on one line.", "기준점 기준계는 한 직선 위에 있지 않은 알려진 점에서 위치, 자세, 축척을 얻습니다.";
    n_control(n): "{n} control", "기준점 {n}개";
    lacks_scale: "Give a distance between two points", "두 점 사이 거리를 주십시오";
    lacks_scale_body: "Neither control nor a distance gives the scale: the size of the result is arbitrary.", "기준점도 거리도 축척을 정하지 않아 결과의 크기가 임의입니다.";
    seen_once(points): "Measure in a second photo: {points}", "두 번째 사진에서 측정할 점: {points}";
    seen_once_body(point, photo): "Point {point} is measured in photo {photo} only. It takes no part; nothing of it is lost.", "점 {point}은(는) 사진 {photo}에만 측정되어 조정에 들어가지 않습니다. 측정은 그대로 남습니다.";
    n_points(n) [point = n "point" "points"]: "{n} {point}", "점 {n}개";
    n_photos(n) [photo = n "photo" "photos"]: "{n} {photo}", "사진 {n}매";
    photo_without_points(photos): "No point is measured in photo {photos}", "측정된 점이 없는 사진: {photos}";
    photo_without_points_body: "It cannot be oriented and takes no part: detect targets with other options, name some by hand, or leave it out.", "표정할 수 없어 조정에 들어가지 않습니다. 다른 설정으로 검출하거나 점을 직접 지정하거나 제외하십시오.";
    hold_or_more(name, camera): "Hold {name} of camera {camera}, or add photos that determine it", "카메라 {camera}의 {name}을(를) 고정하거나 이를 정할 사진을 더하십시오";
    hold_or_more_body(name, ratio, other): "{name} is only {ratio} times its sigma and moves with {other}: the network does not determine both.", "{name}은(는) 표준오차의 {ratio}배에 그치고 {other}와(과) 함께 변합니다. 두 계수가 분리되지 않습니다.";
    look_at(point, photo): "Look at point {point} in photo {photo}", "사진 {photo}의 점 {point}을(를) 확인하십시오";
    look_at_body(n) [exceeding = n "observation exceeds" "observations exceed"]: "{n} {exceeding} the critical value 3.29 of Baarda's w at α 0.1 %. The largest is this one.", "관측 {n}개가 α 0.1 %의 Baarda w 임계값 3.29를 넘습니다. 그중 가장 큰 관측입니다.";
    nothing_lacks: "Every photo is tied and every point determined", "모든 사진이 이어지고 모든 점이 정해졌습니다";
    nothing_lacks_body: "No observation exceeds the critical value, no parameter is left undetermined.", "임계값을 넘는 관측도 정해지지 않은 매개변수도 없습니다.";
    c_found(camera, value): "Principal distance of camera {camera} found: {value}", "카메라 {camera}의 주점거리를 구함: {value}";
    c_assumed(camera, value): "Principal distance of camera {camera} started at {value}", "카메라 {camera}의 주점거리 시작값: {value}";
    c_body: "No value was given; this one is only the start of the adjustment.", "주어진 값이 없어 조정의 시작값으로만 씁니다.";
    photo_not_oriented(photo): "Photo {photo} could not be oriented", "사진 {photo}을(를) 표정하지 못했습니다";
    photo_no_points: "No point is measured in it: detect with other options or name points by hand.", "측정된 점이 없습니다. 다른 설정으로 검출하거나 점을 직접 지정하십시오.";
    photo_too_few(determined, needed): "Only {determined} of its points are known from other photos or control; it takes {needed}.", "다른 사진이나 기준점으로 알려진 점이 {determined}개뿐입니다. {needed}개가 필요합니다.";
    photo_disagrees(determined) [do_not = determined "point does not" "points do not"]: "Its {determined} {do_not} fit together: look for wrong names, or another camera.", "점 {determined}개가 서로 맞지 않습니다. 틀린 점번호나 다른 카메라가 아닌지 확인하십시오.";
    point_not_determined(point): "Point {point} has no coordinates", "점 {point}의 좌표를 정하지 못했습니다";
    point_not_measured: "It was measured in no photo.", "어느 사진에서도 측정되지 않았습니다.";
    point_too_few(photos) [photo = photos "oriented photo" "oriented photos"]: "It is measured in {photos} {photo}; it takes two.", "표정된 사진 {photos}매에서만 측정되었습니다. 두 매가 필요합니다.";
    point_parallel(angle): "Its rays meet at {angle}° only: measure it in a photo from another side.", "광선이 {angle}°로만 만납니다. 다른 쪽에서 찍은 사진에서 측정하십시오.";
    point_behind(photo): "It would lie behind the camera of photo {photo}: look for a wrong name.", "사진 {photo}의 카메라 뒤에 놓입니다. 틀린 점번호가 아닌지 확인하십시오.";
    point_disagrees: "Its rays do not meet: look for a wrong name in one of its photos.", "광선이 만나지 않습니다. 어느 사진의 점번호가 틀렸는지 확인하십시오.";
    point_no_coordinates: "It is a control or check point without coordinates.", "좌표가 없는 기준점 또는 검사점입니다.";
    measurement_disagrees(point, photo): "Point {point} in photo {photo} disagrees with the other measurements", "사진 {photo}의 점 {point}이(가) 다른 측정과 맞지 않습니다";
    measurement_disagrees_body: "A wrong name, most often. Look at it, rename or exclude it.", "대개 점번호가 틀린 경우입니다. 확인하여 이름을 바꾸거나 제외하십시오.";
    behind: "behind", "뒤쪽";
}

// Results
texts! {
    results: "Results", "결과";
    no_result: "There is no result yet", "아직 결과가 없습니다";
    no_result_body: "Run the adjustment; its result appears here.", "광속조정을 실행하면 결과가 여기에 나타납니다.";
    results_stale: "These results are out of date", "결과를 갱신해야 합니다";
    changed_since: "Since the last adjustment:", "마지막 조정 뒤의 변경:";
    no_number_until: "No number is shown until the network is adjusted again.", "다시 조정할 때까지 수치를 보이지 않습니다.";
    a_priori_one: "a priori 1", "사전값 1";
    test_passed: "Global test passed", "전체 모형 검정 통과";
    test_failed: "Global test failed", "전체 모형 검정 실패";
    redundancy: "redundancy", "잉여도";
    rms_residual: "rms residual", "잔차 RMS";
    all_image_coordinates: "all image coordinates", "모든 사진좌표";
    rms_sigma: "rms σ", "RMS σ";
    points_one_sigma(n) [point = n "point" "points"]: "{n} {point}, 1σ", "{n}점, 1σ";
    relative_accuracy: "relative accuracy", "상대정확도";
    largest_dimension(length, unit): "largest dimension {length} {unit}", "최대 치수 {length} {unit}";
    check_rms: "check points rms", "검사점 RMS";
    check_points: "Check points", "검사점";
    adjusted_minus_given: "adjusted minus given", "조정값 − 주어진 값";
    export_csv: "Export CSV", "CSV 내보내기";
    camera_and_correlations(camera): "Camera {camera} and its correlations", "카메라 {camera}와 상관행렬";
    value: "value", "값";
    unit: "unit", "단위";
    rms_x: "rms x", "RMS x";
    rms_y: "rms y", "RMS y";
    rms_summary(x, y, unit, n) [point = n "point" "points"]: "rms x {x}, y {y} {unit}, {n} {point}", "RMS x {x}, y {y} {unit}, {n}점";
    residuals: "Residuals", "잔차";
    residuals_of(photo): "Residuals, photo {photo}", "잔차, 사진 {photo}";
    worst_observations: "Worst observations", "큰 잔차 관측값";
    baarda: "Baarda's w, α 0.1 %", "Baarda w, α 0.1 %";
    over(limit): "over {limit}", "{limit} 초과";
    unchecked: "unchecked", "검증 불가";
    other_observations: "Other observations", "그 밖의 관측값";
    kind_of_observation: "kind", "종류";
    detectable: "detectable", "검출 한계";
    effect: "effect", "영향";
    effect_on: "on point", "영향받는 점";
}

// Changes
texts! {
    change_photos_added(n) [photo = n "photo" "photos"]: "{n} {photo} added", "사진 {n}매 추가";
    change_photo_removed(id): "photo {id} removed", "사진 {id} 제거";
    change_photo_switched(id): "photo {id} excluded or included", "사진 {id} 제외 또는 포함";
    change_camera_edited(id): "camera {id} changed", "카메라 {id} 변경";
    change_camera_assigned(photos, camera) [photo = photos "photo" "photos"]: "camera {camera} given to {photos} {photo}", "사진 {photos}매를 카메라 {camera}에 지정";
    change_detected: "targets detected", "표적 검출";
    change_measured(photo): "a target measured in photo {photo}", "사진 {photo}에서 표적 측정";
    change_named(point): "point {point} named", "점 {point} 지정";
    change_renamed(from, to): "point {from} renamed to {to}", "점 {from} → {to}";
    change_moved(point, photo): "point {point} moved in photo {photo}", "사진 {photo}의 점 {point} 이동";
    change_observation_removed(point, photo): "point {point} removed from photo {photo}", "사진 {photo}의 점 {point} 관측 삭제";
    change_observation_switched(point, photo): "point {point} in photo {photo} excluded or included", "사진 {photo}의 점 {point} 제외 또는 포함";
    change_point_removed(point): "point {point} removed", "점 {point} 삭제";
    change_marks_taken(n) [mark = n "mark" "marks"]: "{n} {mark} taken", "측정점 {n}개 적용";
    change_matched(n) [observation = n "observation" "observations"]: "{n} {observation} matched", "관측 {n}개 정합";
    change_control_taken(n) [point = n "control point" "control points"]: "{n} {point} taken", "기준점 {n}개 적용";
    change_role(point): "role of point {point} changed", "점 {point} 구분 변경";
    change_distance_added(from, to): "distance {from} – {to} added", "거리 {from} – {to} 추가";
    change_distance_removed(from, to): "distance {from} – {to} removed", "거리 {from} – {to} 삭제";
    change_datum: "datum chosen", "기준계 선택";
    change_parameters(camera): "parameters of camera {camera} changed", "카메라 {camera} 매개변수 변경";
    change_options: "weights or search for gross errors chosen", "가중값·과대오차 처리 선택";
    change_adjusted: "adjusted", "조정";
    change_unit: "unit of length changed", "길이 단위 변경";
    change_opened: "project opened", "프로젝트 열기";
}

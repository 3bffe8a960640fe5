//! 사진과 카메라, 사진 보기의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean photos {
    // Photos and cameras
    photos: "사진";
    photos_sentence(photos, cameras): "사진 {photos}매, 카메라 {cameras}대. 제조사·모델·크기·초점거리가 같은 사진은 카메라를 공유합니다.";
    add_photos: "사진 추가…";
    on_to_targets: "표적";
    opening_photos: "사진 여는 중";
    being_read: "읽는 중";
    photo_count(n): "사진 {n}매";
    rows_damaged(photo, rows): "사진 {photo}: 파일의 {rows}행이 손상되어 측정하지 않았습니다";
    page_measured(photo, number, of): "사진 {photo}: 파일에 든 영상 {of}개 가운데 원래 해상도인 {number}번째를 측정합니다";
    first_page_measured(photo, of): "사진 {photo}: 파일에 영상이 {of}개 있습니다. 첫 번째를 측정합니다";
    photo_failed(photo, reason): "사진 {photo}: {reason}";
    no_photo_files: "사진 파일이 없습니다. 이 프로젝트의 사진을 놓으십시오.";
    photo_file_missing(file): "{file} 파일이 없습니다. 보려면 이 페이지에 놓으십시오.";
    not_taken: "추가하지 않은 파일";
    duplicate_of(file): "이미 있는 {file} 파일과 내용이 같습니다";
    same_name_as(photo): "이 프로젝트의 사진 {photo}{photo:과|와} 이름이 같습니다. 선택해야만 연결합니다";
    photos_differ(n, names):
        "이 프로젝트의 사진과 이름은 같지만 내용이 다른 파일 {n}개: {names}. 새 사진으로 추가하겠습니까, 아니면 프로젝트의 사진을 바꾸고 그 사진의 측정값을 삭제하겠습니까?";
    photos_unrecorded(n, names):
        "측정한 사진과 이름과 크기가 같은 파일 {n}개: {names}. 프로젝트에 사진 내용의 기록이 없습니다. 같은 사진입니까?";
    same_photos: "같은 사진";
    add_as_new: "새 사진으로 추가";
    replace_photos: "바꾸고 측정값 삭제";
    developed_of(file): "{file}{file:과|와} 같은 노출이며, 센서 값이 있는 그 파일에서 측정합니다";
    raw_of(file): "이미 있는 {file}{file:과|와} 같은 노출입니다. RAW 파일에서는 센서 값을 그대로 측정합니다";
    measure_raw: "RAW 파일에서 측정";
    measure_developed: "현상된 사진에서 측정";
    unreadable(detail): "브라우저가 파일을 읽지 못했습니다: {detail}";
    cameras: "카메라";
    camera: "카메라";
    camera_named(name): "카메라 {name}";
    camera_of_their_own: "새 카메라";
    picked_photos(n): "고른 사진 {n}매";
    take_part: "조정에 포함";
    remove_from_project: "프로젝트에서 제거";
    make_and_model: "제조사, 모델";
    focal_length: "초점거리";
    film_equivalent(mm): "35 mm 환산 {mm} mm";
    not_in_exif: "EXIF에 없음";
    name: "이름";
    name_taken(name): "이름 \"{name}\"{name:은|는} 비었거나 이미 쓰고 있습니다. 이름은 서로 달라야 합니다.";
    not_a_length(typed): "\"{typed}\"{typed:은|는} 양수가 아닙니다. 3.19와 같이 입력하십시오.";
    not_a_count(typed): "\"{typed}\"{typed:은|는} 개수가 아닙니다. 5와 같이 자연수를 입력하십시오.";
    no_sigma(typed): "\"{typed}\"{typed:은|는} 표준오차가 아닙니다. 0보다 큰 수를 입력하거나 비워 두십시오.";
    centre_without_sigma: "투영중심을 관측값으로 쓰려면 한 축 이상에 표준오차가 필요합니다.";
    pixel_pitch: "화소 크기";
    pitch_um(um): "화소 크기 {um} µm";
    pitch_unknown: "화소 크기 미상, 화소 단위";
    pitch_hint: "화소 크기를 모르면 사진좌표는 화소 단위입니다. 대상점 좌표는 어느 쪽이든 같습니다.";
    principal_distance: "주점거리 초기값";
    unknown: "미상";

    // Photo view
    photo_view(photo): "사진 {photo}";
    fit: "맞춤";
    loupe: "확대경";
    legend_measured: "측정";
    legend_selected: "선택";
    legend_doubtful: "의심";
    legend_excluded: "제외";
} }

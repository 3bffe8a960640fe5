//! 오류의 문장: 무엇이 어디서 잘못되었고 무엇을 할지.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean errors {
    recognised(kind): "{kind} 파일은 지원하지 않습니다. JPEG, PNG, TIFF로 변환하십시오";
    raw_unread(kind): "{kind} 파일은 지원하지 않습니다. 센서 값을 그대로 담는 DNG로 변환하십시오(Adobe DNG Converter, dnglab)";
    decoder_missing(format, message): "{format} 디코더를 불러오지 못했습니다({message}). 이런 파일을 처음 열 때 내려받으므로 그때 네트워크 연결이 필요합니다";
    no_picture: "읽을 수 있는 사진이 아닙니다. JPEG, HEIC, 카메라 RAW, PNG, TIFF, BMP가 필요합니다";
    broken(detail): "사진을 디코딩할 수 없습니다({detail}). 카메라에서 다시 복사하십시오";
    size(width, height, limit): "사진이 {width} × {height} 화소입니다. 1화소부터 {limit}화소까지 처리합니다";
    unknown(kind, name): "{kind} \"{name}\"{name:이|가} 없습니다";
    duplicate(kind, name): "{kind} \"{name}\"{name:이|가} 두 번 나옵니다. 식별자는 서로 달라야 합니다";
    empty(what): "프로젝트에 처리할 {what}{what:이|가} 없습니다";
    initial_values(things): "초기값이 없습니다: {things}";
    not_solved(causes): "망을 풀 수 없습니다: {causes}";
    control_disagrees_all(disagreeing):
        "기준점 {disagreeing}{disagreeing:이|가} 사진과도 서로와도 맞지 않고, 맞는 기준점이 없습니다. 네 점 이상이 맞아야 합니다. 좌표, 축, 단위, 점 이름을 확인하십시오. 두 점이 서로 바뀌었을 수도 있습니다";
    control_disagrees(disagreeing, n, agreeing):
        "기준점 {disagreeing}{disagreeing:이|가} 사진 및 다른 기준점과 맞지 않고, {n}점({agreeing})만 맞습니다. 네 점 이상이고 전체의 절반 이상이 맞아야 합니다. 좌표, 축, 단위, 점 이름을 확인하십시오";
    stopped: "요청에 따라 중지했습니다";
    and_more(names, more): "{names} 외 {more}";
    no_datum(missing): "기준계 매개변수 7개(위치, 자세, 축척) 가운데 {missing}개가 정해지지 않았습니다. 기준점이나 거리를 더하거나 최소구속 또는 자유망을 고르십시오";
    too_few_rays(points): "광선이 부족한 점 {points}: 두 번째 사진에서 측정하거나 좌표를 주거나 제외하십시오";
    photo_undetermined(photos): "점이 부족한 사진 {photos}: 다른 사진이나 기준점으로 결정되는 점을 셋 이상 고르게 측정하거나 사진을 제외하십시오";
    not_tied(groups): "사진 묶음이 서로 연결되지 않습니다({groups}). 공통점을 측정하십시오";
    parameter_undetermined(camera, parameters):
        "카메라 {camera}: 망이 {parameters}{parameters:을|를} 결정하지 못합니다. 고정하거나 표준오차가 있는 관측값으로 주거나, 수렴 촬영과 90° 회전 촬영을 추가하십시오";
    combination(things): "망이 다음의 조합을 결정하지 못합니다: {things}. 일부를 고정하거나 관측값으로 주거나 광선을 추가하십시오";
    all_one_station(photos): "모든 사진({photos})의 촬영 위치가 같아 깊이와 주점거리를 결정할 수 없습니다. 다른 위치에서 사진을 찍거나 기준점을 주십시오";
    kind_photo: "사진";
    kind_point: "점";
    kind_camera: "카메라";
    kind_file: "파일";
    kind_line(n): "{n}행";
    kind_field: "항목";
    some_photos: "사진";
    some_points: "점";
    some_cameras: "카메라";
    some_parameters: "매개변수";
} }

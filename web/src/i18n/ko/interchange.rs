//! 다른 프로그램의 파일에 관한 글: 들어온 것과 그 프로그램용으로 쓰는 것.

use sightline::project::RemovedFields;

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean interchange {
    reading: "파일 읽는 중";
    opened_from(format): "{format} 파일에서 열었음";
    opened_from_earlier: "이전 판에서 저장한 프로젝트";
    kept_by_earlier(ignored): "이전 판에서 저장함. 남기지 않은 것: {ignored}";
    read_from(format, files): "{format}에서 읽음: {files}";
    more_files(files, more): "{files} 외 {more}개";
    assumed: "가정";
    not_kept: "가져오지 않은 것";
    converted: "변환한 카메라 모형";
    assumed_sigma: "파일에 영상 관측값의 표준오차가 없어 모두 1 px로 두었습니다.";
    assumed_size_principal_point: "파일에 영상 크기가 없어 주점 좌표의 두 배로 두었습니다.";
    assumed_from_corner: "COLMAP이 쓰는 방식대로 측정값을 영상 모서리에서 센 것으로 보았습니다. 주점은 점의 투영 위치와의 차이의 중앙값이고, 영상 크기는 그 두 배입니다.";
    assumed_size_measurements: "파일에 영상 크기가 없어 모든 관측값을 담는 가장 작은 크기로 두고, 관측값의 원점을 그 중심으로 했습니다.";
    assumed_four: "왜곡계수 4개를 k1, k2, p1, p2로 읽었습니다. 어안 렌즈라면 이 카메라는 맞지 않습니다.";
    assumed_unit: "파일에 길이 단위가 없습니다. 4단계에서 거리나 기준점을 주기 전까지 프로젝트의 단위는 이름일 뿐입니다.";
    assumed_corner: "파일에 왼쪽 위 화소의 어디가 원점인지 적혀 있지 않아 사진의 모서리로 보았습니다.";
    assumed_chunk: "기준 좌표계가 지리 좌표계나 지도 투영 좌표계이므로 좌표는 청크 자체의 좌표계입니다.";
    local_system: "국지 좌표계";
    local_system_at(latitude, longitude, height): "목록의 위도, 경도, 높이를 WGS84(GRS80) 타원체에서 위도 {latitude}°, 경도 {longitude}°, 높이 {height} m를 원점으로 하는 동·북·상 직각좌표로 변환했습니다. 지도 투영이 아니며 높이는 타원체고로 보았습니다. 이 프로젝트의 다음 목록도 같은 원점을 씁니다.";
    counted(name, count): "{name}: {count}";
    conversion(camera, from, to, max, rms): "{camera}: {from} → {to}, 최대 {max} px, RMS {rms} px.";
    conversion_large: "0.05 px를 넘습니다. 잔차와 좌표에 나타날 수 있습니다.";
    cameras_read(cameras, files): "{files}에서 카메라 {cameras}대를 장비에 보관했습니다.";
    no_camera_fits(size): "열린 프로젝트에 {size} px 카메라가 없어 이 검정을 제안하지 않습니다.";
    several_networks(list): "망 여러 개를 함께 놓았습니다: {list}. 하나씩 여십시오. 아무것도 열지 않았습니다.";
    another_project: "함께 놓은 다른 프로젝트를 열었습니다. 이 파일은 따로 여십시오.";
    conversion_asked(list): "{list} 이 차이를 받아들이고 열까요?";
    read_anyway: "이 차이로 열기";
    for_this_project: "열린 프로젝트의 카메라에 쓰기";
    for_camera(camera): "카메라 {camera}";

    files: "파일";
    files_for_others: "다른 프로그램용 파일";
    files_sentence: "소수점은 마침표입니다. 현재 결과가 있으면 조정된 값을 씁니다.";
    files_stale: "결과가 최신이 아니므로 조정 전 값을 씁니다. 조정된 값을 쓰려면 먼저 조정하십시오.";
    calibrated_camera: "검정된 카메라";
    whole_network: "망 전체";
    points: "점";
    cad: "CAD";
    camera: "카메라";
    values_adjusted: "조정된 값, 공분산 포함";
    values_given: "프로젝트에 주어진 값, 조정 전";
    no_camera_yet: "프로젝트에 아직 카메라가 없습니다.";
    opencv_means: "카메라 행렬과 왜곡계수 5–14개, YAML";
    ros_means: "camera_info, YAML";
    kalibr_means: "camchain, YAML";
    mrcal_means: "cameramodel";
    agisoft_means: "Metashape용 카메라 검정, XML";
    micmac_means: "AutoCal, XML";
    colmap_camera_means: "cameras.txt";
    colmap_means: "카메라, 영상, 점(텍스트)";
    colmap_binary_means: "같은 내용의 이진 파일";
    bundler_means: "bundle.out과 사진 목록";
    bal_means: "Bundle Adjustment in the Large, 텍스트 한 개";
    meshroom_means: "AliceVision의 scene.sfm";
    metashape_means: "카메라와 마커, XML";
    opencv_points_means: "카메라 검정용 사진별 영상점과 대상점, YAML";
    tables_means: "점, 카메라, 사진, 관측값과 표준오차, 잔차";
    tabs_means: "같은 내용, 탭 구분";
    control_means: "주어진 좌표와 표준오차";
    vstars_means: "점과 표준오차";
    dxf_means: "레이어별 점, 선, 점 이름";
    ply_means: "점, 타원체, 카메라";
    gltf_means: "3차원 보기 장면";
    prepare: "준비";
    preparing: "준비 중";
    download: "내려받기";
    download_format(format): "{format} 내려받기";
    prepare_format(format): "{format} 준비";
    exact: "카메라 모형을 변환 없이 그대로 씁니다.";
    converted_covariance: "매개변수의 공분산을 함께 씁니다.";
    no_place(list): "이 형식이 지원하지 않는 것: {list}.";
    write_anyway: "이 차이로 준비";
}}

/// 엔진이 세는, 가져오지 않은 것의 이름. 목록에 없는 것은 파일의 요소 이름이다.
pub fn ignored(name: &str) -> Option<&'static str> {
    Some(match name {
        "cameras without orientation" => "표정되지 않은 카메라",
        "colours and errors of points" => "점의 색과 오차",
        "colours of points" => "점의 색",
        RemovedFields::OF_PHOTOS => "사진을 측정한 색",
        "disabled observations" => "사용하지 않는 관측값",
        "distances" => "거리",
        "features" => "측정한 형상",
        "free" => "추정할 매개변수 선택",
        "further chunks" => "다른 청크",
        "further columns" => "나머지 열",
        "further frames" => "다른 프레임",
        "further measurements of a point in a photo" => "한 사진에서 같은 점의 추가 관측값",
        "given coordinates as such" => "주어진 좌표라는 표시",
        "images" => "영상",
        "interior orientations of photos" => "사진별 내부표정",
        "keypoints of no point" => "점이 없는 특징점",
        RemovedFields::OF_CAMERAS => "카메라의 배율 색수차와 이를 쓴 결과",
        RemovedFields::OF_REPORT => "보고서의 배율 색수차",
        "markers" => "마커",
        "measurements in cameras without orientation" => "표정되지 않은 카메라의 관측값",
        "measurements in photos without a sensor" => "센서가 없는 사진의 관측값",
        "metadata" => "메타데이터",
        "observations of points without coordinates" => "좌표가 없는 점의 관측값",
        "observations of what is not written" => "쓰지 않은 사진이나 점의 관측값",
        "observations without coordinates" => "좌표가 없는 관측값",
        "photos" => "사진",
        "photos without a sensor" => "센서가 없는 사진",
        "photos without orientation or disabled" => "표정되지 않았거나 사용하지 않는 사진",
        "photos without points" => "점이 없는 사진",
        "pixel_pitch" => "화소 크기(mm)",
        "points without coordinates" => "좌표가 없는 점",
        "points3D" => "points3D",
        "geographic positions of photos" => "사진의 지리 좌표",
        "poses of rigs" => "리그의 자세",
        "poses without a view" => "영상이 없는 자세",
        "principal points and sizes of pictures" => "주점과 영상 크기",
        "reference coordinates of cameras" => "카메라의 기준 좌표",
        "reference coordinates of markers" => "마커의 기준 좌표",
        "rigs" => "리그",
        "scalebars" => "스케일바",
        "sigma" => "매개변수의 사전 표준오차",
        "standard errors of observations" => "관측값의 표준오차",
        _ => return None,
    })
}

//! 카메라 검정: 순서, 사진의 분포, 사진 부분 간 비교.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean calibrating {
    calibration: "검정";
    calibrate: "카메라 검정";
    calibrate_words: "원형 격자판이나 인쇄한 표적지를 찍은 사진으로 내부표정과 그 불확도를 구하고 다른 프로그램용 파일을 만듭니다";
    sentence(photos, measurements): "사진 {photos}매, 관측 {measurements}개.";
    nothing_yet: "검정판에서 카메라 파일까지 네 단계입니다.";
    object: "1 검정판 또는 표적지";
    object_words: "원형 격자판(크기 무관, 대칭 또는 비대칭)이나, 좌표 목록이 있는 코드·점 표적지를 씁니다. 평평해야 하며 사진 몇 매에서는 화면을 가득 채워야 합니다.";
    print: "표적지 인쇄";
    load_control: "표적지의 control.csv 불러오기";
    name_dots: "격자판의 점에 이름 붙이기";
    photos: "2 사진";
    photos_words: "초점과 줌을 고정하고 여러 방향에서 찍습니다. 일부는 30~45° 기울이고 일부는 90° 돌려 찍으며, 판이 사진 모서리에도 오게 합니다.";
    detect: "표적 찾기";
    covering: "표적의 분포를 계산하는 중";
    covered: "표적의 분포";
    by_radius: "중심에서 모서리까지의 표적 수";
    by_roll: "광축 회전별 사진 수";
    by_tilt: "판에 대한 기울기별 사진 수";
    not_oriented: "회전과 기울기는 조정한 뒤에 알 수 있습니다.";
    reach(percent): "가장 바깥 표적은 중심에서 모서리까지 거리의 {percent} %에 있습니다.";
    covers_all: "부족한 것이 없습니다.";
    lack_photos(n): "관측이 있는 사진이 {n}매뿐입니다. 8매 이상 찍으십시오.";
    lack_radius: "모서리 쪽에 표적이 없어 그곳의 왜곡은 외삽한 값입니다. 판이 모서리에 오게 찍으십시오.";
    lack_cells: "표적이 없는 화면 부분이 있습니다. 그 부분을 채우도록 찍으십시오.";
    lack_roll: "90° 돌려 찍은 사진이 없습니다. 주점과 편심왜곡은 이런 사진으로 정해지므로 카메라를 돌려 몇 매 찍으십시오.";
    lack_tilt: "모든 사진이 판을 정면으로 봅니다. 주점거리와 촬영거리를 구분할 수 없으므로 일부는 30~45° 기울여 찍으십시오.";
    result: "3 결과";
    to_adjustment: "조정과 매개변수";
    to_results: "결과";
    files: "4 파일";
    files_words: "OpenCV, ROS, Kalibr, mrcal, COLMAP, Metashape, MicMac. 변환에서 달라지는 양을 함께 표시합니다.";
    to_files: "다른 프로그램용 파일";
    cross: "교차 검증";
    cross_why: "사진의 절반씩으로 카메라를 따로 검정하고, 두 결과의 차이를 표준오차와 비교합니다.";
    crossing: "사진 절반씩 검정하는 중";
    agrees(ratio, limit): "두 절반이 일치합니다. 차이는 표준오차의 {ratio}배 이하입니다(한계 {limit}).";
    larger_noise(ratio, limit): "두 절반의 차이가 표준오차의 {ratio}배까지 나지만(한계 {limit}) 잔차로 설명되는 정도입니다. 사진좌표의 표준오차가 너무 작습니다.";
    wrong_model(ratio, limit): "두 절반의 차이가 표준오차의 {ratio}배까지 납니다(한계 {limit}). 카메라 모형이 맞지 않거나 촬영 중 카메라나 대상이 변했습니다.";
    predicted: "예측";
    observed: "실제";
    map_words: "사진 위치별 두 절반의 차이(화소): 표준오차로 예측한 값과 실제 값을 같은 눈금으로 그렸습니다. 빗금: 가까이에 표적이 없음.";
    up_to(px): "≤ {px} px";
    beyond(px): "> {px} px";
    worst(u, v): "최대 위치: {u}, {v} px.";
    proposed(degrees, models): "초점거리로 보면 대각선 화각이 {degrees}°입니다. 이런 렌즈에는 대개 {models} 모형이 필요합니다. 자동으로 바꾸지 않으니 사진을 측정한 뒤 모형을 비교하십시오.";
    propose_use(model): "{model} 사용";
} }

//! 계통적인 잔차: 무엇에 따라 달라지는지, 원인과 대책.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean systematic {
    radius(camera, px): "카메라 {camera}: 잔차가 방사거리에 따라 달라집니다(최대 {px} px)";
    radius_body: "원인: 카메라 모형이 설명하지 못하는 방사왜곡.";
    tangential(camera, px): "카메라 {camera}: 잔차에 접선 방향 패턴이 있습니다(최대 {px} px)";
    tangential_body: "원인: 편심왜곡 또는 주점 이동.";
    affine(camera, px): "카메라 {camera}: 행과 열 방향의 축척이 다릅니다(최대 {px} px)";
    affine_body: "원인: 화소가 정사각형이 아니거나 영상의 두 축이 직교하지 않습니다.";
    row(camera, px): "카메라 {camera}: 잔차가 행에 따라 커집니다(최대 {px} px)";
    column(camera, px): "카메라 {camera}: 잔차가 열에 따라 커집니다(최대 {px} px)";
    read_out_body: "원인: 센서를 판독하는 동안 카메라나 대상이 움직였습니다(롤링 셔터).";
    position(camera, px): "카메라 {camera}: 모든 사진의 잔차가 같은 패턴을 보입니다(최대 {px} px)";
    position_body: "원인: 카메라 모형의 매개변수로 설명되지 않는 완만한 영상 변형.";
    photo(photos, px): "{photos}: 내부표정이 다른 사진과 다릅니다(최대 {px} px)";
    photo_body: "원인: 줌이나 초점의 변화, 잘린 사진, 다른 영상 크기.";
    every_photo(camera, px): "카메라 {camera}: 내부표정이 사진마다 다릅니다(최대 {px} px)";
    every_photo_body: "원인: 줌 또는 자동 초점.";
    estimate(parameters): "추정할 매개변수: {parameters}.";
    estimate_now(parameters): "{parameters} 추정";
    other_model(models): "이 렌즈에는 다른 카메라 모형이 필요합니다: {models}.";
    hold_still: "카메라와 대상을 고정하거나, 짧은 노출이나 플래시로 촬영하거나, 글로벌 셔터 카메라를 사용하십시오.";
    own_camera: "이 사진들에 별도의 카메라를 지정하십시오.";
    per_photo: "촬영할 때 줌과 초점을 고정하거나 사진마다 내부표정을 추정하십시오.";
    inspect: "렌즈 앞의 유리창, 고르지 않은 센서나 필름, 중심에서 벗어나 측정된 표적을 확인하십시오.";
    photos_tested(n): "사진 {n}매를 하나씩 검사함";
    not_noise: "잡음이 아니라 계통오차이므로 결과의 표준오차에는 들어 있지 않습니다.";
} }

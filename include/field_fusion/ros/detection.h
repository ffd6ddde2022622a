#pragma once
// What the detector's boxes mean in space, as messages, and drawn into the image.
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/core/cloud/plane.h"
#include "field_fusion/core/detect/letterbox.h"
#include "field_fusion/core/detect/yolo_detector.h"
#include "field_fusion/ros/camera_model.h"

namespace field_fusion {

/// An image message as OpenCV sees it; shares the message's memory where no conversion is needed.
struct ImageView {
  cv::Mat pixels;
  core::PixelOrder order = core::PixelOrder::kBgr;
};

/// bgr8, rgb8 and mono8 as they are; what cv_bridge turns into bgr8, turned. Throws std::runtime_error
/// "image ...: details" for any other encoding and for sizes that disagree with the data.
ImageView viewOf(const sensor_msgs::Image::ConstPtr& image);

/// Detections with bearing (paper 001 Eqs. 4-6) and range (Eq. 3, and from `ground`, a plane in the camera's
/// optical frame that may be NaN); both NaN where `camera` is null.
boost::shared_ptr<ImageDetectionArray> detectionMessage(const std_msgs::Header& header, cv::Size image,
                                                        const core::Detections& detections,
                                                        const std::vector<std::string>& class_names,
                                                        const CameraModel* camera, const core::Plane& ground,
                                                        const core::RangeParams& params);

/// A bgr8 copy of the image with each detection's box, class, score, range and azimuth.
boost::shared_ptr<sensor_msgs::Image> annotated(const ImageView& image,
                                                const ImageDetectionArray& detections);

}  // namespace field_fusion

#pragma once
// The whole detector: model file, letterbox, network, decoding.
#include <memory>
#include <string>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/detect/inference.h"
#include "field_fusion/core/detect/letterbox.h"
#include "field_fusion/core/detect/mono_range.h"
#include "field_fusion/core/detect/yolo.h"

namespace field_fusion::core {

struct DetectParams {
  std::string model;
  std::string class_file;
  std::string camera_info_url;
  InferenceParams inference;
  YoloParams yolo;
  RangeParams range;

  void declare(Params& p) {
    p.text("model", model, When::kStart, "ONNX file of a YOLOv8 detection model.");
    p.text("class_file", class_file, When::kStart,
           "Names of the classes: one a line, or a YAML file with 'names'. Empty: those in the model file.");
    p.text("camera_info_url", camera_info_url, When::kStart,
           "Calibration of a camera whose driver sends none: file:///PATH or package://PACKAGE/PATH of a file "
           "as camera_calibration writes it. Empty: the topic camera_info.");
    inference.declare(p);
    yolo.declare(p);
    range.declare(p);
  }
};

/// Not thread-safe: one caller at a time.
class YoloDetector {
 public:
  /// Throws std::runtime_error that names the file and the fault. The model is run once, to know that it can.
  /// `class_file` may be empty: the names in the model file count then.
  YoloDetector(const OnnxFile& model, const std::string& class_file, const InferenceParams& inference = {});

  /// The result holds until the next call. std::invalid_argument for an image that Letterbox
  /// refuses; std::runtime_error where the network fails.
  const Detections& detect(const cv::Mat& image, PixelOrder order, const YoloParams& params);

  /// What runs the network, and why not another backend: a line for people.
  const std::string& backend() const { return loaded_.backend; }
  /// By class_id.
  const std::vector<std::string>& classNames() const { return class_names_; }

 private:
  LoadedNetwork loaded_;
  std::vector<std::string> class_names_;
  Letterbox letterbox_;
  YoloDecoder decoder_;
};

}  // namespace field_fusion::core

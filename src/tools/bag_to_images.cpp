// Pictures of a bag -> JPEG files, and with a topic of boxes YOLO's label files beside them.
#include <cv_bridge/cv_bridge.h>
#include <ros/package.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "open_bag.h"
#include "progress.h"
#include "yolo_labels.h"

namespace {

using namespace field_fusion;
namespace fs = std::filesystem;

struct Options {
  std::string bag, out, topic, labels, classes, set;
  std::size_t every = 1;
  int quality = 95;
  LabelLimits limits;
};

bool isImage(const std::string& type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

/// The topic asked for, or the only one with pictures.
std::string imageTopic(const rosbag::Bag& bag, const std::string& wanted) {
  std::map<std::string, std::string> types;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (connection->topic == wanted && !isImage(connection->datatype))
      throw std::runtime_error(wanted + " has no images but " + connection->datatype);
    if (isImage(connection->datatype)) types[connection->topic] = connection->datatype;
  }
  std::string names;
  for (const auto& entry : types) names += (names.empty() ? "" : ", ") + entry.first;
  const std::string those = names.empty() ? "; the bag has no images" : "; the bag has images on " + names;
  if (!wanted.empty() && !types.count(wanted)) throw std::runtime_error("no topic " + wanted + those);
  if (wanted.empty() && types.size() != 1) throw std::runtime_error("--topic is needed" + those);
  return wanted.empty() ? types.begin()->first : wanted;
}

struct Unwritable : std::runtime_error {
  explicit Unwritable(const fs::path& file) : std::runtime_error("cannot write " + file.string()) {}
};

void writeBytes(const fs::path& file, const std::uint8_t* bytes, std::size_t size) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  if (!out.flush()) throw Unwritable(file);
}

void writeJpeg(const fs::path& file, const cv::Mat& bgr, int quality) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  writeBytes(file, bytes.data(), bytes.size());
}

bool isJpeg(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 4 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

/// A camera may pad its JPEG with zeros; one that is cut off has no end.
bool isWhole(const std::vector<std::uint8_t>& jpeg) {
  const auto last = std::find_if(jpeg.rbegin(), jpeg.rend(), [](std::uint8_t byte) { return byte != 0; });
  return jpeg.rend() - last > 4 && *last == 0xd9 && *(last + 1) == 0xff;
}

/// A picture that is JPEG already stays as it is to the byte. Throws std::exception for what is none.
void writePicture(const fs::path& file, const rosbag::MessageInstance& message, int quality) {
  if (const auto image = message.instantiate<sensor_msgs::Image>()) {
    if (image->width == 0 || image->height == 0) throw std::runtime_error("it has no pixels");
    return writeJpeg(file, cv_bridge::toCvShare(image, "bgr8")->image, quality);
  }
  const auto packed = message.instantiate<sensor_msgs::CompressedImage>();
  if (!isJpeg(packed->data)) {
    const cv::Mat image = cv::imdecode(packed->data, cv::IMREAD_COLOR);
    if (image.empty()) throw std::runtime_error("it cannot be decoded");
    return writeJpeg(file, image, quality);
  }
  if (!isWhole(packed->data)) throw std::runtime_error("its JPEG is cut off");
  writeBytes(file, packed->data.data(), packed->data.size());
}

ros::Time stampOf(const rosbag::MessageInstance& message) {
  if (const auto image = message.instantiate<sensor_msgs::Image>()) return image->header.stamp;
  return message.instantiate<sensor_msgs::CompressedImage>()->header.stamp;
}

fs::path folderIn(const Options& options, const char* what) {
  const fs::path folder =
      options.labels.empty() ? fs::path(options.out) : fs::path(options.out) / what / options.set;
  fs::create_directories(folder);
  return folder;
}

/// How many pictures are damaged.
std::size_t extract(const Options& options) {
  rosbag::Bag bag;
  openBag(bag, options.bag);
  const std::string topic = imageTopic(bag, options.topic);
  LabelFiles labels;
  if (!options.labels.empty()) labels = readLabels(bag, options.labels, options.classes, options.limits);
  const fs::path images = folderIn(options, "images"), texts = folderIn(options, "labels");
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::size_t count = 0, written = 0, without = 0, damaged = 0;
  for (const rosbag::MessageInstance& message : view) {
    if (count++ % options.every != 0) continue;
    const std::string name = fs::path(options.bag).stem().string() + cv::format("_%06zu", count - 1);
    const auto label = labels.find(stampOf(message));
    if (!options.labels.empty() && label == labels.end()) {
      ++without;
      continue;
    }
    try {
      writePicture(images / (name + ".jpg"), message, options.quality);
    } catch (const Unwritable&) {
      throw;
    } catch (const std::exception& fault) {
      std::cerr << topic << ", picture " << count - 1 << " of stamp " << stampOf(message) << ": " << fault.what() << "\n";
      ++damaged;
      continue;
    }
    if (label != labels.end())
      writeBytes(texts / (name + ".txt"), reinterpret_cast<const std::uint8_t*>(label->second.data()),
                 label->second.size());
    ++written;
    showProgress(count, view.size());
  }
  std::cout << options.out << ": " << written << " pictures of " << count << " on " << topic;
  if (without > 0)
    std::cout << "; " << without << " left out, " << options.labels << " has none of their stamp";
  if (damaged > 0) std::cout << "; " << damaged << " left out as damaged";
  std::cout << "\n";
  return damaged;
}

void declare(CLI::App& app, Options& options) {
  app.add_option("bag", options.bag, "file to read")->required()->check(CLI::ExistingFile);
  app.add_option("out", options.out, "folder to write to")->required();
  app.add_option("--topic", options.topic, "Image or CompressedImage (default: the only one)");
  app.add_option("--every", options.every, "takes one of so many pictures")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  app.add_option("--quality", options.quality, "of the JPEG where the bag has none")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  auto* labels = app.add_option("--labels", options.labels,
                                "ImageDetectionArray: writes OUT/images/ and OUT/labels/ as YOLO takes them");
  app.add_option("--classes", options.classes, "YAML file with a list `names`")
      ->capture_default_str()
      ->needs(labels);
  app.add_option("--set", options.set, "folder below images/ and labels/, such as train")->needs(labels);
  app.add_option("--min-score", options.limits.score,
                 "of a box; of the simulator's truth the share that is seen")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--min-area", options.limits.area, "of a box [px^2]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.classes = ros::package::getPath("field_fusion") + "/models/classes.yaml";
  CLI::App app("Writes the pictures of a bag as JPEG files BAG_NUMBER.jpg, and labels in YOLO's format.");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    if (extract(options) > 0) return EXIT_FAILURE;
  } catch (const std::exception& e) {
    std::cerr << "bag_to_images: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

#include "field_fusion/core/io/octree_file.h"

#include <octomap/OcTree.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/io/replace_file.h"

namespace field_fusion::core {
namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 16;                                 // of OctoMap's trees
constexpr std::size_t kMostLoaded = std::size_t{1} << 28;  // voxels

bool isBinary(const fs::path& file) {
  if (file.extension() == ".bt") return true;
  if (file.extension() == ".ot") return false;
  throw std::runtime_error(file.string() + ": the name ends neither in .bt nor in .ot");
}

/// The library trusts what it reads: damaged data leads it past the file's end, or down without one. So the
/// nodes are walked first.
class Walk {
 public:
  Walk(const std::string& data, std::size_t at) : data_(data), at_(at) {}

  /// A node: its log-odds, a bit for each child, the children.
  void full(int depth) {
    ++nodes_;
    float log_odds;
    std::memcpy(&log_odds, take(sizeof log_odds), sizeof log_odds);
    if (!std::isfinite(log_odds)) throw std::runtime_error("a node's log-odds are not finite");
    const auto children = static_cast<unsigned char>(*take(1));
    if (children != 0) deeper(depth);
    for (int i = 0; i < 8; ++i)
      if (children >> i & 1) full(depth + 1);
  }
  /// A node: two bits for each child, both where that is a node with children of its own; these children.
  void binary(int depth) {
    deeper(depth);
    std::uint16_t children;
    std::memcpy(&children, take(sizeof children), sizeof children);
    for (int i = 0; i < 8; ++i)
      if ((children >> 2 * i & 3) == 3) binary(depth + 1);
  }
  bool atEnd() const { return at_ == data_.size(); }
  std::size_t nodes() const { return nodes_; }  ///< of `full`

 private:
  static void deeper(int depth) {
    if (depth >= kDepth) throw std::runtime_error("the tree is deeper than " + std::to_string(kDepth));
  }
  const char* take(std::size_t bytes) {
    if (data_.size() - at_ < bytes) throw std::runtime_error("it ends within the tree");
    at_ += bytes;
    return data_.data() + at_ - bytes;
  }
  const std::string& data_;
  std::size_t at_;
  std::size_t nodes_ = 0;
};

/// The number that a line of the header gives; NaN without.
double headerValue(const std::string& header, const std::string& name) {
  const auto line = header.find("\n" + name + " ");
  if (line == std::string::npos) return kNaN;
  double value = kNaN;
  std::istringstream(header.substr(line + name.size() + 2)) >> value;
  return value;
}

void check(const std::string& data, bool binary) {
  const std::string first = binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file";
  if (data.compare(0, first.size(), first) != 0)
    throw std::runtime_error("its first line is not '" + first + "'");
  if (data.find("\nid OcTree\n") == std::string::npos) throw std::runtime_error("it is no OcTree");
  const std::string mark = "\ndata\n";
  const auto head = data.find(mark);
  if (head == std::string::npos) throw std::runtime_error("it has no data");
  const std::string header = data.substr(0, head + 1);
  if (!(headerValue(header, "res") > 0.0)) throw std::runtime_error("it does not tell the size of its voxels (res)");
  if (data.size() == head + mark.size()) return;  // a tree of nothing
  Walk walk(data, head + mark.size());
  binary ? walk.binary(0) : walk.full(0);
  if (!walk.atEnd()) throw std::runtime_error("it goes on after the tree");
  if (!binary && headerValue(header, "size") != static_cast<double>(walk.nodes()))
    throw std::runtime_error("its tree has " + std::to_string(walk.nodes()) + " nodes, not what its header says (size)");
}

octomap::OcTree treeLike(const VoxelMapParams& p) {
  octomap::OcTree tree(p.resolution);
  tree.setClampingThresMin(p.clamp_min), tree.setClampingThresMax(p.clamp_max),
      tree.setOccupancyThres(p.occupied);
  return tree;
}

octomap::OcTree read(const std::string& data, bool binary, const VoxelMapParams& p) {
  check(data, binary);
  std::istringstream in(data);
  octomap::OcTree tree = treeLike(p);
  if (binary) {
    if (!tree.readBinary(in)) throw std::runtime_error("OctoMap cannot read it");
  } else {
    const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(in));
    auto* const found = dynamic_cast<octomap::OcTree*>(any.get());
    if (!found) throw std::runtime_error("OctoMap cannot read it");
    tree.swapContent(*found);
    tree.setResolution(found->getResolution());
  }
  if (std::abs(tree.getResolution() / p.resolution - 1.0) > 1e-4)
    throw std::runtime_error("its voxels are of " + floatText(tree.getResolution()) + " m, not " +
                             floatText(p.resolution) + " m");
  return tree;
}

std::size_t voxelsAlong(const octomap::OcTree::leaf_iterator& leaf) {
  return std::size_t{1} << (kDepth - leaf.getDepth());
}

octomap::OcTree treeOf(const VoxelMap& map) {
  octomap::OcTree tree = treeLike(map.params());
  map.store().forEach([&](const CubeKey& place, const VoxelCube& cube) {
    forEachBit(cube.known, [&](int i) {
      const VoxelKey voxel = voxelOf(place, i);
      const auto part = [&](int axis) { return static_cast<octomap::key_type>(voxel[axis] + kMostVoxels); };
      tree.setNodeValue(octomap::OcTreeKey(part(0), part(1), part(2)), cube.log_odds[i], true);
    });
  });
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

}  // namespace

void writeOctree(const fs::path& file, const VoxelMap& map) {
  const bool binary = isBinary(file);
  octomap::OcTree tree = treeOf(map);
  replaceFile(file, [&](std::ostream& out) { binary ? tree.writeBinary(out) : tree.write(out); });
}

std::string octreeData(const VoxelMap& map, bool binary) {
  octomap::OcTree tree = treeOf(map);
  std::ostringstream out;
  if (binary) tree.toMaxLikelihood(), tree.prune();
  if (tree.size() > 0) binary ? tree.writeBinaryData(out) : tree.writeData(out);
  return out.str();
}

void readOctree(const fs::path& file, VoxelMap& map) try {
  const bool binary = isBinary(file);
  if (fs::is_directory(file)) throw std::runtime_error("it is a folder");
  std::ifstream in(file, std::ios::binary);
  const std::string data((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.is_open() || in.bad()) throw std::runtime_error("cannot be read");
  const octomap::OcTree tree = read(data, binary, map.params());
  std::size_t voxels = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    voxels += voxelsAlong(leaf) * voxelsAlong(leaf) * voxelsAlong(leaf);
  if (voxels > kMostLoaded)
    throw std::runtime_error("it has " + std::to_string(voxels) + " voxels, too many to hold");
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto low = leaf.getIndexKey();  // of the leaf's first voxel
    const int side = static_cast<int>(voxelsAlong(leaf));
    for (int i = 0; i < side * side * side; ++i) {
      const VoxelKey in_leaf(i % side, i / side % side, i / side / side);
      map.set(VoxelKey(low[0], low[1], low[2]) + in_leaf - VoxelKey::Constant(kMostVoxels),
              leaf->getLogOdds());
    }
  }
} catch (const std::runtime_error& e) {
  const std::string what = e.what();
  if (what.compare(0, file.string().size(), file.string()) == 0) throw;
  throw std::runtime_error(file.string() + ": " + what);
}

}  // namespace field_fusion::core

#include "harness/scenario/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxTriangles = 2'000'000;
constexpr std::size_t kMaxParts = 1000;

/// Corners by number, each place once.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// A file system without files.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char* /*file*/) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* /*file*/, const char* /*mode*/) override { return nullptr; }
  void Close(Assimp::IOStream* /*file*/) override {}
};

struct LessByCoordinates {
  bool operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }
};

class MeshReader {
 public:
  MeshReader(const std::string& name, const std::string& text) : name_(name) {
    std::string ending = std::filesystem::path(name).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    Assimp::Importer importer;
    if (ending.empty() || !importer.IsExtensionSupported(ending)) {
      fail("a mesh file (.stl, .obj, .ply, .dae or another that Assimp reads)",
           ending.empty() ? "no ending" : "." + ending);
    }
    // Coordinates as they are written, as readers of URDF take them, whatever axis is said to be up.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetIOHandler(new NoFiles);  // which the importer deletes
    const aiScene* scene = importer.ReadFileFromMemory(
        text.data(), text.size(), aiProcess_Triangulate | aiProcess_PreTransformVertices,
        ending.c_str());
    if (scene == nullptr) fail("a mesh that can be read", importer.GetErrorString());
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) add(*scene->mMeshes[m]);
    if (mesh_.triangles.empty()) fail("triangles", "none");
  }

  const Mesh& mesh() const { return mesh_; }

  [[noreturn]] void fail(const std::string& expected, const std::string& got) const {
    throw InputError(fmt::format("{}: expected {}, got {}", name_, expected, got));
  }

 private:
  void add(const aiMesh& mesh) {
    if (mesh_.triangles.size() + mesh.mNumFaces > kMaxTriangles) {
      fail(fmt::format("at most {} triangles", kMaxTriangles), "more");
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // a point or line
      std::array<int, 3> corners{};
      for (unsigned k = 0; k < 3; ++k) corners[k] = number(mesh.mVertices[face.mIndices[k]]);
      mesh_.triangles.push_back(corners);
    }
  }

  int number(const aiVector3D& vertex) {
    const Eigen::Vector3d place(vertex.x, vertex.y, vertex.z);
    if (!place.allFinite()) fail("finite coordinates", "one that is not");
    const auto [known, is_new] = numbers_.try_emplace(place, static_cast<int>(numbers_.size()));
    if (is_new) mesh_.vertices.push_back(place);
    return known->second;
  }

  const std::string& name_;
  Mesh mesh_;
  std::map<Eigen::Vector3d, int, LessByCoordinates> numbers_;
};

/// For each vertex one that stands for all that are connected with it: the first of them.
std::vector<int> connected(const Mesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int vertex) {
    while (parent[static_cast<std::size_t>(vertex)] != vertex) {
      int& up = parent[static_cast<std::size_t>(vertex)];
      up = parent[static_cast<std::size_t>(up)];
      vertex = up;
    }
    return vertex;
  };
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    for (const int corner : {triangle[1], triangle[2]}) {
      const int a = root(triangle[0]), b = root(corner);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<int> result;
  result.reserve(parent.size());
  for (int vertex = 0; vertex < static_cast<int>(parent.size()); ++vertex) {
    result.push_back(root(vertex));
  }
  return result;
}

/// By the divergence theorem; none for a surface that is not closed.
std::optional<double> enclosed_volume(const Mesh& part) {
  std::map<std::pair<int, int>, int> edges;  // how often from one to the other
  double sum = 0;
  const Eigen::Vector3d& base = part.vertices.front();
  for (const std::array<int, 3>& triangle : part.triangles) {
    const auto side = [&](std::size_t k) -> Eigen::Vector3d {
      return part.vertices[static_cast<std::size_t>(triangle[k])] - base;
    };
    sum += side(0).cross(side(1)).dot(side(2));
    for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
  }
  const bool closed = std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
  if (!closed) return std::nullopt;
  return std::abs(sum) / 6;
}

}  // namespace

std::vector<MeshPart> read_mesh(const std::string& name, const std::string& text) {
  const MeshReader reader(name, text);
  const Mesh& mesh = reader.mesh();
  const std::vector<int> connection = connected(mesh);
  std::map<int, Mesh> parts;
  std::vector<int> number_in_part(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    std::vector<Eigen::Vector3d>& vertices = parts[connection[v]].vertices;
    number_in_part[v] = static_cast<int>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = number_in_part[static_cast<std::size_t>(triangle[k])];
    }
    parts[connection[static_cast<std::size_t>(triangle[0])]].triangles.push_back(corners);
  }
  if (parts.size() > kMaxParts) {
    reader.fail(fmt::format("at most {} parts that are not connected", kMaxParts),
                std::to_string(parts.size()));
  }
  std::vector<MeshPart> result;
  result.reserve(parts.size());
  for (const auto& [first, part] : parts) {
    result.push_back({convex_hull(part.vertices), enclosed_volume(part)});
  }
  return result;
}

}  // namespace bqsa::harness

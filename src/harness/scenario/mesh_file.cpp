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
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

#include "harness/guarded_call.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxTriangles = 2'000'000;
constexpr std::size_t kMaxParts = 1000;

/// Of the largest coordinate: corners this near to each other are meant to be one. Single precision
/// rounds by less.
constexpr double kWeld = 1e-6;

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;  ///< each once
  std::vector<int> places;                ///< for each vertex a number that those nearby have, too
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

[[noreturn]] void refuse(const std::string& name, const std::string& expected,
                         const std::string& got) {
  throw InputError(fmt::format("{}: expected {}, got {}", name, expected, got));
}

/// In lower case, without the dot.
std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

/// Coordinates of the corners of all triangles, as Assimp gives them.
std::vector<float> imported(const std::string& name, const std::string& text) {
  const std::string ending = ending_of(name);
  Assimp::Importer importer;
  const bool is_of_many_formats = ending == "xml";
  if (ending.empty() || is_of_many_formats || !importer.IsExtensionSupported(ending)) {
    refuse(name, "a mesh file (.stl, .obj, .ply, .dae or another that Assimp reads)",
           ending.empty() ? "no ending" : "." + ending);
  }
  // Coordinates as they are written, as readers of URDF take them, whatever axis is said to be up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetIOHandler(new NoFiles);  // which the importer deletes
  const aiScene* scene = importer.ReadFileFromMemory(
      text.data(), text.size(), aiProcess_Triangulate | aiProcess_PreTransformVertices,
      ending.c_str());
  if (scene == nullptr) refuse(name, "a mesh that can be read", importer.GetErrorString());
  std::vector<float> corners;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // a point or line
      if (corners.size() >= 9 * kMaxTriangles) {
        refuse(name, fmt::format("at most {} triangles", kMaxTriangles), "more");
      }
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& corner = mesh.mVertices[face.mIndices[k]];
        corners.insert(corners.end(), {corner.x, corner.y, corner.z});
      }
    }
  }
  return corners;
}

/// Likewise. Some files make Assimp recurse without end or take all memory.
std::vector<float> imported_guarded(const std::string& name, const std::string& text) {
  std::string bytes;
  try {
    bytes = guarded_call([&] {
      const std::vector<float> corners = imported(name, text);
      return std::string(reinterpret_cast<const char*>(corners.data()),
                         corners.size() * sizeof(float));
    });
  } catch (const EndedCall& ended) {
    refuse(name, "a mesh that can be read",
           fmt::format("one that Assimp does not survive: {}", ended.what()));
  }
  std::vector<float> corners(bytes.size() / sizeof(float));
  if (!corners.empty()) std::memcpy(corners.data(), bytes.data(), bytes.size());
  return corners;
}

Mesh mesh_of(const std::string& name, const std::vector<float>& corners) {
  if (corners.empty()) refuse(name, "triangles", "none");
  Mesh mesh;
  std::map<Eigen::Vector3d, int, LessByCoordinates> numbers;
  for (std::size_t first = 0; first < corners.size(); first += 9) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float* at = &corners[first + 3 * k];
      const Eigen::Vector3d place(at[0], at[1], at[2]);
      if (!place.allFinite()) refuse(name, "finite coordinates", "one that is not");
      const auto [known, is_new] = numbers.try_emplace(place, static_cast<int>(numbers.size()));
      if (is_new) mesh.vertices.push_back(place);
      triangle[k] = known->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// For each vertex the number of one nearby that stands for all in its place: files repeat corners, and
/// some programs round each copy anew.
std::vector<int> places_of(const std::vector<Eigen::Vector3d>& vertices) {
  double largest = 0;
  for (const Eigen::Vector3d& p : vertices) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  const double near = kWeld * largest;
  const double width = 4 * near;  // of a cell, more than that of the cube around what is near
  using Cell = std::array<std::int64_t, 3>;
  const auto cell_of = [&](const Eigen::Vector3d& p) {
    Cell cell{};
    if (width > 0) {
      for (int k = 0; k < 3; ++k) {
        cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p(k) / width));
      }
    }
    return cell;
  };
  std::map<Cell, std::vector<int>> known;  // those that stand for others
  std::vector<int> result;
  result.reserve(vertices.size());
  for (const Eigen::Vector3d& p : vertices) {
    const auto number = static_cast<int>(result.size());
    int found = number;
    // What is near lies in one of the cells of the eight corners of a cube around the point.
    for (unsigned corner = 0; corner < 8 && found == number; ++corner) {
      const auto shift = [&](unsigned bit) { return (corner & bit) != 0 ? near : -near; };
      const auto cell = known.find(cell_of(p + Eigen::Vector3d(shift(1), shift(2), shift(4))));
      if (cell == known.end()) continue;
      for (const int other : cell->second) {
        if ((vertices[static_cast<std::size_t>(other)] - p).norm() <= near) found = other;
      }
    }
    if (found == number) known[cell_of(p)].push_back(number);
    result.push_back(found);
  }
  return result;
}

/// For each vertex one that stands for all that are connected with it: the first of them.
std::vector<int> connected(const Mesh& mesh) {
  std::vector<int> parent = mesh.places;
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
    const auto place = [&](std::size_t k) {
      return part.places[static_cast<std::size_t>(triangle[k])];
    };
    if (place(0) == place(1) || place(1) == place(2) || place(2) == place(0)) continue;
    for (std::size_t k = 0; k < 3; ++k) ++edges[{place(k), place((k + 1) % 3)}];
  }
  const bool closed = std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
  if (!closed) return std::nullopt;
  return std::abs(sum) / 6;
}

}  // namespace

bool states_unit(const std::string& name) {
  const std::string ending = ending_of(name);
  return ending == "dae" || ending == "zae";
}

std::vector<MeshPart> read_mesh(const std::string& name, const std::string& text) {
  Mesh mesh = mesh_of(name, imported_guarded(name, text));
  mesh.places = places_of(mesh.vertices);
  const std::vector<int> connection = connected(mesh);
  std::map<int, Mesh> parts;
  std::vector<int> number_in_part(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Mesh& part = parts[connection[v]];
    number_in_part[v] = static_cast<int>(part.vertices.size());
    part.vertices.push_back(mesh.vertices[v]);
    part.places.push_back(mesh.places[v]);
  }
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = number_in_part[static_cast<std::size_t>(triangle[k])];
    }
    parts[connection[static_cast<std::size_t>(triangle[0])]].triangles.push_back(corners);
  }
  if (parts.size() > kMaxParts) {
    refuse(name, fmt::format("at most {} parts that are not connected", kMaxParts),
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

// Meshes: formats, parts, and files that are none.

#include "harness/scenario/mesh_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// A box from `low` to `high`, as 8 corners and 12 triangles counterclockwise from outside.
struct Cuboid {
  Vector3d low, high;

  static constexpr std::array<std::array<unsigned, 3>, 12> kTriangles = {{{0, 2, 3},
                                                                          {0, 3, 1},
                                                                          {4, 5, 7},
                                                                          {4, 7, 6},
                                                                          {0, 1, 5},
                                                                          {0, 5, 4},
                                                                          {2, 6, 7},
                                                                          {2, 7, 3},
                                                                          {0, 4, 6},
                                                                          {0, 6, 2},
                                                                          {1, 3, 7},
                                                                          {1, 7, 5}}};

  Vector3d corner(unsigned k) const {
    return {(k & 1U) != 0 ? high.x() : low.x(), (k & 2U) != 0 ? high.y() : low.y(),
            (k & 4U) != 0 ? high.z() : low.z()};
  }
};

const Cuboid kUnit{{0, 0, 0}, {1, 1, 1}};
const Cuboid kLong{{3, 0, 0}, {3.5, 4, 0.25}};

std::string obj(const std::vector<Cuboid>& cuboids) {
  std::string text = "mtllib missing.mtl\n";
  unsigned base = 1;
  for (const Cuboid& cuboid : cuboids) {
    for (unsigned k = 0; k < 8; ++k) {
      const Vector3d p = cuboid.corner(k);
      text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    }
    for (const auto& t : Cuboid::kTriangles) {
      text += fmt::format("f {} {} {}\n", base + t[0], base + t[1], base + t[2]);
    }
    base += 8;
  }
  return text;
}

std::string ascii_stl(const std::vector<Cuboid>& cuboids) {
  std::string text = "solid test\n";
  for (const Cuboid& cuboid : cuboids) {
    for (const auto& t : Cuboid::kTriangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const unsigned k : t) {
        const Vector3d p = cuboid.corner(k);
        text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
      }
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid test\n";
}

std::string binary_stl(const std::vector<Cuboid>& cuboids) {
  std::string text(80, ' ');
  const auto append = [&](const auto& value) {
    std::array<char, sizeof(value)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(value));
    text.append(bytes.data(), bytes.size());
  };
  append(static_cast<std::uint32_t>(12 * cuboids.size()));
  for (const Cuboid& cuboid : cuboids) {
    for (const auto& t : Cuboid::kTriangles) {
      for (int k = 0; k < 3; ++k) append(0.0F);
      for (const unsigned k : t) {
        for (const double x : cuboid.corner(k)) append(static_cast<float>(x));
      }
      append(std::uint16_t{0});
    }
  }
  return text;
}

std::string ply(const std::vector<Cuboid>& cuboids) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float "
      "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      8 * cuboids.size(), 12 * cuboids.size());
  for (const Cuboid& cuboid : cuboids) {
    for (unsigned k = 0; k < 8; ++k) {
      const Vector3d p = cuboid.corner(k);
      text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    }
  }
  unsigned base = 0;
  for ([[maybe_unused]] const Cuboid& cuboid : cuboids) {
    for (const auto& t : Cuboid::kTriangles) {
      text += fmt::format("3 {} {} {}\n", base + t[0], base + t[1], base + t[2]);
    }
    base += 8;
  }
  return text;
}

/// One geometry for each cuboid, half as large and as far, in a node that doubles it.
std::string collada(const std::vector<Cuboid>& cuboids, const std::string& up = "Y_UP") {
  std::string geometries, nodes;
  for (std::size_t i = 0; i < cuboids.size(); ++i) {
    std::string places, indices;
    for (unsigned k = 0; k < 8; ++k) {
      const Vector3d p = 0.5 * cuboids[i].corner(k);
      places += fmt::format("{} {} {} ", p.x(), p.y(), p.z());
    }
    for (const auto& t : Cuboid::kTriangles) {
      indices += fmt::format("{} {} {} ", t[0], t[1], t[2]);
    }
    geometries += fmt::format(
        "<geometry id='g{0}'><mesh><source id='s{0}'><float_array id='f{0}' count='24'>{1}"
        "</float_array><technique_common><accessor source='#f{0}' count='8' stride='3'>"
        "<param name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/>"
        "</accessor></technique_common></source><vertices id='v{0}'><input semantic='POSITION' "
        "source='#s{0}'/></vertices><triangles count='12'><input semantic='VERTEX' source='#v{0}' "
        "offset='0'/><p>{2}</p></triangles></mesh></geometry>",
        i, places, indices);
    nodes += fmt::format(
        "<node id='n{0}'><scale>2 2 2</scale><instance_geometry url='#g{0}'/></node>", i);
  }
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><up_axis>" +
         up + "</up_axis></asset><library_geometries>" + geometries +
         "</library_geometries><library_visual_scenes><visual_scene id='s'>" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
         "</COLLADA>";
}

void expect_cuboid(const MeshPart& part, const Cuboid& cuboid) {
  const double expected = (cuboid.high - cuboid.low).prod();
  EXPECT_NEAR(volume(part.hull), expected, 1e-6);
  ASSERT_TRUE(part.volume.has_value());
  EXPECT_NEAR(*part.volume, expected, 1e-6);
  ASSERT_EQ(part.hull.vertices.size(), 8U);
  Vector3d low = part.hull.vertices.front(), high = low;
  for (const Vector3d& p : part.hull.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_TRUE(low.isApprox(cuboid.low, 1e-6)) << low.transpose();
  EXPECT_TRUE(high.isApprox(cuboid.high, 1e-6)) << high.transpose();
}

TEST(MeshFile, IsReadInEveryFormatPartByPart) {
  const std::vector<Cuboid> two = {kUnit, kLong};
  const std::vector<std::pair<std::string, std::string>> files = {
      {"two.obj", obj(two)}, {"two.stl", ascii_stl(two)}, {"TWO.STL", binary_stl(two)},
      {"two.ply", ply(two)}, {"two.dae", collada(two)},   {"z.dae", collada(two, "Z_UP")}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const std::vector<MeshPart> parts = read_mesh(name, text);
    ASSERT_EQ(parts.size(), 2U);
    expect_cuboid(parts[0], kUnit);
    expect_cuboid(parts[1], kLong);
  }
}

TEST(MeshFile, OfPolygonsIsTriangulated) {
  const std::string quads =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
      "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const std::vector<MeshPart> parts = read_mesh("quads.obj", quads);
  ASSERT_EQ(parts.size(), 1U);
  expect_cuboid(parts[0], kUnit);
}

TEST(MeshFile, WithoutAnInsideIsTheHullOfItsCornersAndHasNoVolume) {
  const std::string whole = obj({kUnit});
  const std::string open = whole.substr(0, whole.rfind("f "));
  const std::string turned = open + "f 2 6 8\n";  // the last triangle the wrong way round
  const std::string fin = whole + "v 0.5 0.5 0.5\nf 1 2 9\n";  // three triangles at an edge
  for (const std::string& text : {open, turned, fin}) {
    const std::vector<MeshPart> parts = read_mesh("box.obj", text);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_NEAR(volume(parts[0].hull), 1, 1e-6);
    EXPECT_FALSE(parts[0].volume.has_value());
  }
}

TEST(MeshFile, OfBoxesThatShareAnEdgeIsOnePartWithoutAVolume) {
  const std::vector<MeshPart> parts = read_mesh("two.obj", obj({kUnit, {{1, 1, 0}, {2, 2, 1}}}));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(volume(parts[0].hull), 3, 1e-6);
  EXPECT_FALSE(parts[0].volume.has_value()) << "four triangles at an edge";
}

TEST(MeshFile, OfAPartThatIsNotConvexHasLessVolumeThanItsHull) {
  // A cube with a corner pushed in to the middle. As seen from the corner opposite, six triangles
  // remain, each with a tetrahedron of 1/12.
  std::string text = obj({kUnit});
  const std::size_t place = text.find("v 1 1 1\n");
  text.replace(place, 8, "v 0.5 0.5 0.5\n");
  const std::vector<MeshPart> parts = read_mesh("dent.obj", text);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_TRUE(parts[0].volume.has_value());
  EXPECT_NEAR(volume(parts[0].hull), 5.0 / 6, 1e-6);
  EXPECT_NEAR(*parts[0].volume, 0.5, 1e-6);
}

TEST(MeshFile, LeavesOutPointsAndLines) {
  const std::vector<MeshPart> parts =
      read_mesh("box.obj", obj({kUnit}) + "v 5 5 5\nv 6 6 6\nl 9 10\np 9\n");
  ASSERT_EQ(parts.size(), 1U);
  expect_cuboid(parts[0], kUnit);
}

TEST(MeshFile, OfASheetIsFlat) {
  const std::vector<MeshPart> parts =
      read_mesh("sheet.obj", "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\n");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].hull.span, 2);
  EXPECT_EQ(parts[0].hull.vertices.size(), 4U);
  EXPECT_FALSE(parts[0].volume.has_value());
}

std::string refusal(const std::string& name, const std::string& text) {
  try {
    read_mesh(name, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshFile, ThatIsNoneIsRefusedByName) {
  using testing::AllOf;
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_EQ(refusal("a/box.obj", obj({kUnit})), "accepted");
  EXPECT_THAT(refusal("a/box", obj({kUnit})), AllOf(StartsWith("a/box: "), HasSubstr("no ending")));
  EXPECT_THAT(refusal("a/box.txt", obj({kUnit})),
              AllOf(StartsWith("a/box.txt: "), HasSubstr(".txt")));
  EXPECT_THAT(refusal("box.xml", collada({kUnit})), HasSubstr("got .xml"));
  for (const std::string ending : {"obj", "stl", "ply", "dae"}) {
    const std::string name = "a/box." + ending;
    EXPECT_THAT(refusal(name, ""), StartsWith(name + ": expected")) << ending;
    EXPECT_THAT(refusal(name, "nonsense"), StartsWith(name + ": expected")) << ending;
  }
  EXPECT_EQ(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n"),
            "points.obj: expected triangles, got none");
  EXPECT_EQ(refusal("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"),
            "lines.obj: expected triangles, got none");
  EXPECT_THAT(refusal("empty.ply", ply({})), StartsWith("empty.ply: expected"));
  std::string cut_off = binary_stl({kUnit});
  cut_off.resize(cut_off.size() / 2);
  EXPECT_THAT(refusal("half.stl", cut_off), StartsWith("half.stl: expected"));
  std::string not_a_number = obj({kUnit});
  not_a_number.replace(not_a_number.find("v 1 1 1"), 7, "v 1 nan 1");
  EXPECT_THAT(refusal("nan.obj", not_a_number), StartsWith("nan.obj: expected"));
}

/// Programs that write each triangle by itself may round each copy of a corner anew; zeros stay zeros.
TEST(MeshFile, OfCornersThatDifferInTheLastDigitsHangsTogether) {
  for (const Vector3d& place : {Vector3d(10, -20, 30), Vector3d(0, 0, 0), Vector3d(-1, 0, 0.5)}) {
    std::string text = "solid test\n";
    int copy = 0;
    for (const auto& t : Cuboid::kTriangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const unsigned k : t) {
        const Vector3d p = place + kUnit.corner(k);
        const double rounded = 1 + 1e-7 * (copy++ % 7 - 3);
        text += fmt::format("vertex {:.8g} {:.8g} {:.8g}\n", p.x() * rounded, p.y() / rounded,
                            p.z() * rounded);
      }
      text += "endloop\nendfacet\n";
    }
    const std::vector<MeshPart> parts = read_mesh("box.stl", text + "endsolid test\n");
    ASSERT_EQ(parts.size(), 1U) << place.transpose();
    EXPECT_NEAR(volume(parts[0].hull), 1, 1e-4);
    ASSERT_TRUE(parts[0].volume.has_value());
    EXPECT_NEAR(*parts[0].volume, 1, 1e-4);
  }
}

TEST(MeshFile, OfBoxesWithAGapBetweenThemIsTwoParts) {
  EXPECT_EQ(read_mesh("two.obj", obj({kUnit, {{1.00001, 0, 0}, {2, 1, 1}}})).size(), 2U);
}

TEST(MeshFile, StatesItsUnitInColladaAlone) {
  std::string text = collada({kLong});
  text.insert(text.find("<up_axis>"), "<unit name='millimeter' meter='0.001'/>");
  const std::vector<MeshPart> parts = read_mesh("long.dae", text);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(volume(parts[0].hull), 0.5e-9, 1e-14);
  for (const char* name : {"a.dae", "b/A.DAE", "a.zae"}) EXPECT_TRUE(states_unit(name)) << name;
  for (const char* name : {"a.stl", "a.obj", "dae"}) EXPECT_FALSE(states_unit(name)) << name;
}

/// Assimp recurses over the nodes of a file, without looking how often.
TEST(MeshFile, OnWhichAssimpCrashesIsRefusedByName) {
  const std::string good = collada({kUnit});
  std::string loop = good;
  loop.insert(loop.find("</node>"), "<instance_node url='#n0'/>");
  std::string deep = good;
  std::string open, close;
  for (int i = 0; i < 100'000; ++i) {
    open += "<node>";
    close += "</node>";
  }
  deep.insert(deep.find("</visual_scene>"), open + close);
  for (const std::string& text : {loop, deep}) {
    EXPECT_THAT(refusal("crash.dae", text),
                testing::StartsWith("crash.dae: expected a mesh that can be read, got one that "
                                    "Assimp does not survive: "));
  }
}

TEST(MeshFile, OfTooManyPartsIsRefused) {
  std::vector<Cuboid> many;
  for (int i = 0; i <= 1000; ++i) {
    many.push_back({{2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}});
  }
  EXPECT_THAT(refusal("many.obj", obj(many)), testing::HasSubstr("at most 1000 parts"));
  many.pop_back();
  EXPECT_EQ(read_mesh("many.obj", obj(many)).size(), 1000U);
}

}  // namespace
}  // namespace bqsa::harness

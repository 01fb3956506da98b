// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scene as plain data, in Blender's words and units. Nothing here knows of rendering.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "janus/image/image.h"
#include "janus/math/vec.h"
#include "janus/scene/linking.h"
#include "janus/scene/node_graph.h"
#include "janus/scene/ray_type.h"

namespace janus {

// Whose values an attribute holds: one for the mesh, or one each for its points, corners or faces.
enum class AttributeDomain { Mesh, Point, Corner, Face };

// Numbers on a mesh, under the key that programs ask for (see shading/node_emitter.h).
struct AttributeDesc {
  std::string key;
  AttributeDomain domain = AttributeDomain::Point;
  int channels = 3;           // 1 to 4
  std::vector<float> values;  // interleaved; empty: to be computed (see geometry/derived.h)
};

// The vertices of a mesh at another time.
struct MeshKey {
  std::vector<vec3> positions, normals;  // as many as the mesh has of each
};

struct MeshDesc {
  std::string name;
  std::vector<vec3> positions;
  std::vector<glm::uvec3> triangles;       // indices of corners
  std::vector<uint32_t> corner_vertices;   // corner -> position; empty: corners are the positions
  std::vector<vec3> vertex_normals;        // per position; or
  std::vector<vec3> corner_normals;        // per corner; neither: flat shading
  std::vector<uint32_t> material_indices;  // per triangle, slot of the instance; empty: slot 0
  std::vector<uint32_t> faces;             // per triangle, its face; empty: each is a face
  std::vector<AttributeDesc> attributes;
  std::vector<glm::uvec2> edges;  // pairs of positions; where an attribute is to be computed
  // At even times, from the one when the shutter opens to the one when it closes; empty: always as
  // above. Normals are those of vertices or corners, whichever it has.
  std::vector<MeshKey> motion{};
};

// Tubes along curves (hair, grass), or balls (a point cloud).
struct RoundDesc {
  std::string name;
  std::vector<vec3> positions;  // of the curves' keys, or of the balls' centres
  std::vector<float> radii;     // at each
  // Where each curve begins among the positions, and where the last one ends. They go through their
  // keys smoothly (Catmull-Rom), or straight. Empty: balls.
  std::vector<uint32_t> curves;
  bool straight = false;
  std::vector<uint32_t> material_indices;  // per curve or ball, slot of the instance; empty: slot 0
  std::vector<AttributeDesc> attributes;   // of points, and of curves as faces
  std::vector<MeshKey> motion{};           // as a mesh's, without normals
};

struct InstanceDesc {
  std::string name;
  std::string mesh;                                   // key, or that of what is round
  mat4 transform = mat4(1.0f);                        // object to world
  std::vector<std::optional<std::string>> materials;  // keys by slot; nullopt: default surface
  RayMask visibility = kAllRays;                      // the rays that meet it
  bool holdout = false;  // leaves a hole in the picture where the camera sees it
  // Part of the footage that the picture is laid over, which shows only what is done to its light.
  // Of those that hold out, only with regard to other shadow catchers.
  bool shadow_catcher = false;
  // What the Object Info node says.
  vec4 color = vec4(1.0f);
  float object_index = 0.0f;  // the pass index
  float random = 0.0f;        // a number of the instance's own, in [0, 1]
  // What programs ask of it, by their keys (see shading/node_emitter.h).
  std::map<std::string, vec4> attributes;
  std::string light_group{};   // where what it emits belongs; empty: nowhere
  std::string asset{};         // the name by which Cryptomatte knows it as a part; empty: its own
  std::vector<mat4> motion{};  // transforms at such times; empty: it stands still
  EmitterLinks emitter{};
  ReceiverLinks receiver{};
};

struct MaterialDesc {
  std::string name;
  NodeGraph graph;
  bool sample_emission = true;  // false: what it emits is found by chance only
  float material_index = 0.0f;  // the pass index
  NodeGraph aovs{};             // that ends in AOV Output nodes
};

// A picture for texture nodes, which name its key in their property "image".
struct ImageDesc {
  std::string name;
  std::shared_ptr<const Image> pixels;  // three channels or more, scene-linear unless `srgb`
  bool srgb = false;                    // the pixels are encoded as sRGB
  bool associated = false;              // colours have been multiplied by alpha (as encoded)
};

enum class LightType { Point, Spot, Sun, Area };
enum class AreaShape { Square, Rectangle, Disk, Ellipse };

struct LightDesc {
  std::string name;
  LightType type = LightType::Point;
  mat4 transform = mat4(1.0f);  // lights shine along their local -z
  Rgb color = Rgb(1.0f);
  float energy = 10.0f;   // watts (sun: W/m^2)
  float exposure = 0.0f;  // stops
  bool normalize = true;  // energy is power; false: it does not spread over the surface
  float radius = 0.0f;    // point, spot
  bool soft_falloff = true;
  AreaShape shape = AreaShape::Square;
  float size = 0.25f, size_y = 0.25f;  // area; metres before the transform
  float spread = kPi;                  // area; full angle, radians
  float angle = 0.0f;                  // sun; full angle, radians
  float spot_size = 0.785398f, spot_blend = 0.15f;
  bool spot_square = false;
  RayMask visibility = kAllRays;   // to the camera, and to labels
  bool cast_shadow = true;         // false: its light passes everything
  int max_bounces = 1024;          // of the paths that it lights
  std::optional<NodeGraph> graph;  // the light's own node tree
  std::string light_group{};       // empty: none
  EmitterLinks links{};
  bool lights_catchers =
      true;  // false: it is no part of the footage (InstanceDesc::shadow_catcher)
};

struct WorldDesc {
  std::string name;
  std::optional<NodeGraph> graph;  // nullopt: black
  RayMask visibility = kAllRays;   // to the camera, and to labels
  std::string light_group{};       // empty: none
  NodeGraph aovs{};                // that ends in AOV Output nodes
};

// All but the first two are panoramas: see panorama.h.
enum class CameraType {
  Perspective,
  Orthographic,
  Equirectangular,
  FisheyeEquidistant,
  FisheyeEquisolid,
  FisheyeLensPolynomial,
  MirrorBall,
  EquiangularCubemapFace,
  CentralCylindrical
};

// What fisheyes have besides their frame.
struct FisheyeDesc {
  float fov = kPi;     // from rim to rim, radians: nothing is to be seen outside
  float lens = 10.5f;  // equisolid: focal length, millimetres
  // K0 to K4 of the polynomial: minus the angle from the view axis, radians, by millimetres.
  std::array<float, 5> polynomial = {0.0f, -1.0f / 18.0f, 0.0f, 0.0f, 0.0f};
};

struct CameraDesc {
  std::string name;
  CameraType type = CameraType::Perspective;
  mat4 transform = mat4(1.0f);  // camera to world; looks down local -z, +y is up
  // The full frame. Perspective: on the plane at distance 1. Orthographic: metres. Panoramas: on
  // their film, in the units of panorama.h; 0 is the centre of the view.
  float left = -0.5f, right = 0.5f, bottom = -0.5f, top = 0.5f;
  FisheyeDesc fisheye;
  // Panoramas: how far the frame has been shifted, in widths and heights of it. It is where it is;
  // but Cycles' Window coordinates are those of the frame before.
  vec2 shift = vec2(0.0f);
  // Distances along the view axis; panoramas: along the ray.
  float clip_start = 0.1f, clip_end = 1000.0f;
  // Depth of field.
  float aperture_radius = 0.0f;  // metres; 0: everything is in focus
  float focus_distance = 10.0f;  // along the view axis; panoramas: along the ray
  int aperture_blades = 0;       // corners; below 3: round
  float aperture_rotation = 0.0f;
  float aperture_ratio = 1.0f;  // height to width; 2: half as wide
  // The height of a pixel in the units of the frame: how closely bump looks. 0: a thousandth.
  float pixel_size = 0.0f;
  // At such times; empty: it stands still.
  struct Key {
    mat4 transform = mat4(1.0f);
    float left = -0.5f, right = 0.5f, bottom = -0.5f, top = 0.5f;
  };
  std::vector<Key> motion{};
  // How open the shutter is, at even times from opening to closing; empty: equally at all times.
  std::vector<float> shutter{};
};

}  // namespace janus

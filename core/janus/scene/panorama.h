// SPDX-License-Identifier: GPL-3.0-or-later
//
// How panoramas map places of the film to directions, as Cycles has it. Directions are the
// camera's own: it looks along -z, +x is to the right and +y is up.
//
// The units of places are those of CameraDesc's frame:
//   equirectangular            longitude and latitude, radians
//   equidistant fisheye        angle from the view axis, radians, to the right and up
//   equisolid, polynomial      millimetres on the sensor
//   mirror ball                radii of the ball's disk
//   equiangular cubemap face   angles from the view axis, radians, to the right and up
//   central cylindrical        longitude, radians, and height on a cylinder of radius 1
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "janus/scene/description.h"

namespace janus {

using dvec2 = glm::dvec2;
using dvec3 = glm::dvec3;

inline bool is_panorama(CameraType type) {
  return type != CameraType::Perspective && type != CameraType::Orthographic;
}

// Can a Panorama be made of it? Blender's fisheyes go around five times at most.
bool usable_fisheye(const FisheyeDesc& fisheye);

class Panorama {
 public:
  // `type` must be that of a panorama.
  Panorama(CameraType type, const FisheyeDesc& fisheye);

  // What a place of the film sees.
  struct View {
    dvec3 direction;     // unit
    double solid_angle;  // steradians per unit of area on the film
  };
  // nullopt outside the field of view.
  std::optional<View> look(dvec2 place) const;

  // Places of the film; room for all that see two directions, however a fisheye folds.
  struct Places {
    std::array<dvec2, 96> at;
    size_t count = 0;

    void add(dvec2 place) {
      if (count < at.size()) {
        at[count++] = place;
      }
    }
  };
  // Adds the places that see a unit direction, but for whole periods.
  void find(dvec3 direction, Places& places) const;

  // The film goes on and repeats itself after so much; 0: it does not.
  dvec2 period() const;

  // The axes by which lenses are placed: a rotation from the camera's. Cycles' mirror ball has axes
  // of its own; what is ahead there is to its right.
  const glm::dmat3& lens_axes() const { return lens_axes_; }
  // And the y axis of its lenses runs the other way.
  bool lens_mirrored() const { return type_ == CameraType::MirrorBall; }

 private:
  // A range of radii in which the angle from the view axis rises or falls, and its angles there,
  // as far as they are in the field of view.
  struct Piece {
    double from, to;
    double least, most;
  };

  std::optional<View> look_equisolid(dvec2 place) const;
  std::optional<View> look_polynomial(dvec2 place) const;
  void find_equisolid(dvec3 direction, Places& places) const;
  void find_polynomial(dvec3 direction, Places& places) const;

  CameraType type_;
  // Equisolid, and the mirror ball, which is a lens of half a radius.
  double lens_ = 0.5, rim_ = 1.0;  // focal length, and the radius of what it sees
  // Polynomial, and the equidistant fisheye, whose polynomial is the radius itself: the angle from
  // the view axis by the radius. Negative angles are on the other side of the axis.
  std::array<double, 5> polynomial_{};
  double half_fov_ = 0.0;
  std::vector<Piece> pieces_;
  glm::dmat3 lens_axes_ = glm::dmat3(1.0);
};

// Where Cycles' Window coordinates have a direction: one place, beyond the field of view as well.
dvec2 window_place(CameraType type, const FisheyeDesc& fisheye, dvec3 direction);

// Radians per unit of height in the middle of the film: how large a pixel is, for bump.
float pixel_scale(CameraType type, const FisheyeDesc& fisheye);

}  // namespace janus

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blackbody: the colour of a glowing body, of luminance 1, in Rec.709. The fit is Cycles': between
// temperatures, a / t + b t + c for red and green and a cubic for blue.
#include <algorithm>
#include <iterator>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"

namespace janus {

namespace {

struct Piece {
  float from;              // kelvin
  float red[3], green[3];  // of 1 / t, t, 1
  float blue[4];           // of t^3, t^2, t, 1
};

constexpr Piece kPieces[] = {
    {800.0f,
     {1.61919106e+03f, -2.05010916e-03f, 5.02995757e+00f},
     {-4.88999748e+02f, 6.04330754e-04f, -7.55807526e-02f},
     {5.96945309e-11f, -4.85742887e-08f, -9.70622247e-05f, -4.07936148e-03f}},
    {965.0f,
     {2.48845471e+03f, -1.11330907e-03f, 3.22621544e+00f},
     {-7.55994277e+02f, 3.16730098e-04f, 4.78306139e-01f},
     {2.40430366e-11f, 5.55021075e-08f, -1.98503712e-04f, 2.89312858e-02f}},
    {1167.0f,
     {3.34143193e+03f, -4.86551192e-04f, 1.76486769e+00f},
     {-1.02363977e+03f, 1.20223470e-04f, 9.36662319e-01f},
     {-1.40949732e-11f, 1.89878968e-07f, -3.56632824e-04f, 9.10767778e-02f}},
    {1449.0f,
     {4.09461742e+03f, -1.27446582e-04f, 7.25731635e-01f},
     {-1.26571316e+03f, 4.87340896e-06f, 1.27054498e+00f},
     {-3.61460868e-11f, 2.84822009e-07f, -4.93211319e-04f, 1.56723440e-01f}},
    {1902.0f,
     {4.67028036e+03f, 2.91258199e-05f, 1.26703442e-01f},
     {-1.42529332e+03f, -4.01150431e-05f, 1.43972784e+00f},
     {-1.97075738e-11f, 1.75359352e-07f, -2.50542825e-04f, -2.22783266e-02f}},
    {3315.0f,
     {4.59509185e+03f, 2.87495649e-05f, 1.50345020e-01f},
     {-1.17554822e+03f, -2.16378048e-05f, 1.30408023e+00f},
     {-1.61997957e-13f, -1.64216008e-08f, 3.86216271e-04f, -7.38077418e-01f}},
    {6365.0f,
     {3.78717450e+03f, 9.35907826e-06f, 3.99075871e-01f},
     {-5.00799571e+02f, -4.59832026e-06f, 1.09098763e+00f},
     {6.72650283e-13f, -2.73078809e-08f, 4.24098264e-04f, -7.52335691e-01f}},
};
const Rgb kHottest(0.8262954810464208f, 0.9945080501520986f, 1.566307710274283f);
const Rgb kDimmest(5.413294490189271f, -0.20319390035873933f, -0.0822535242887164f);

vec3 blackbody(float t) {
  Rgb color = t >= 12000.0f ? kHottest : kDimmest;
  if (t >= 800.0f && t < 12000.0f) {
    const Piece* piece = std::begin(kPieces);
    while (piece + 1 != std::end(kPieces) && t >= piece[1].from) {
      ++piece;
    }
    const auto rational = [t](const float* c) { return c[0] / t + c[1] * t + c[2]; };
    const float* b = piece->blue;
    color = Rgb(rational(piece->red), rational(piece->green),
                ((b[0] * t + b[1]) * t + b[2]) * t + b[3]);
  }
  return glm::max(color, Rgb(0.0f));  // deep red lies outside of Rec.709
}

constexpr SocketDecl kInputs[] = {{"Temperature", SocketType::Float, 1500.0f}};
constexpr std::string_view kOutputs[] = {"Color"};

void emit_blackbody(NodeEmitter& e) {
  e.output("Color",
           e.convert(e.emit(pure<&blackbody>, {e.input("Temperature")}), SocketType::Color));
}

}  // namespace

std::span<const NodeDecl> blackbody_nodes() {
  static const NodeDecl kNodes[] = {{"BLACKBODY", kInputs, kOutputs, &emit_blackbody}};
  return kNodes;
}

}  // namespace janus

#include "rough_boxes.h"

using namespace snug;
using namespace snug::contact;

namespace {
/// Two boxes with friction whose facing sides are mirror images in the plane of height 1. Both are
/// round, or hollow, with the @p radius of a circle or a sphere.
template <int dim>
struct MirrorImages : public RoughBoxes<dim>
{
  using typename RoughBoxes<dim>::Field;

  MirrorImages(double radius, unsigned int degree, Method method)
    : RoughBoxes<dim>(boxes(radius), degree)
  {
    this->rough.parameters.method = method;
    // Nodes that move along the sides, the same ones on both sides.
    for (auto &x : this->positions)
      {
        const double s = x[0] * (1. - x[0]), y = dim == 3 ? x[1] * (1. - x[1]) : 0.25;
        x[0] += 0.3 * s * y;
        if (dim == 3)
          x[1] -= 0.4 * s * y;
      }
  }

  static typename RoughBoxes<dim>::Bodies boxes(double radius)
  {
    auto              bodies = RoughBoxes<dim>::boxes(6, 6);
    const std::string shape  = (dim == 2 ? "cylinder z " : "sphere ") + std::to_string(radius);
    bodies[0].curved_faces["bottom"] = bodies[1].curved_faces["top"] = shape;
    return bodies;
  }

  /// Return a random field on the master with its mirror image on the slave.
  Field mirrored_field() const
  {
    auto result = this->random_field(3);
    for (unsigned int node = 0; node < result.size(); ++node)
      if (!this->is_master(node))
        {
          auto x               = this->positions[node];
          x[dim - 1]           = 2. - x[dim - 1];
          unsigned int nearest = 0;
          for (unsigned int other = 0; other < result.size(); ++other)
            if (this->is_master(other) &&
                ((this->positions[other] - x).norm() < (this->positions[nearest] - x).norm() ||
                 !this->is_master(nearest)))
              nearest = other;
          EXPECT_LT((this->positions[nearest] - x).norm(), 1e-12);
          result[node] = result[nearest];
          result[node][dim - 1] *= -1.;
        }
    return result;
  }
};

/// Bodies that deform as mirror images do not slip, and their normals are at right angles to the
/// mirror.
template <int dim>
void expect_no_slip(const MirrorImages<dim> &scene)
{
  const auto contact  = scene.contact();
  const auto rows     = contact.rows(scene.positions);
  const auto tangents = contact.tangent_rows(scene.positions, rows);
  const auto u        = scene.mirrored_field();
  ASSERT_EQ(tangents.size(), (dim - 1) * rows.size());
  EXPECT_GE(rows.size(), std::pow(7, dim - 1));
  double largest_slip = 0., largest_tilt = 0., largest_gap = 0.;
  for (const auto &row : rows)
    {
      largest_tilt = std::max(largest_tilt, 1. + row.normal[dim - 1]);
      largest_gap  = std::max(largest_gap, std::abs(row.gap));
    }
  for (const auto &row : tangents)
    {
      double slip = 0.;
      for (const auto &[node, c] : row.coefficients)
        slip += c * u[node];
      largest_slip = std::max(largest_slip, std::abs(slip));
    }
  EXPECT_GT(largest_gap, 0.05);
  EXPECT_LT(largest_tilt, 1e-14);
  EXPECT_LT(largest_slip, 1e-12);
}

template <int dim, typename Check>
void for_each_pair_of_images(const Check &check)
{
  for (const Method method : {Method::nodal, Method::mortar})
    for (const unsigned int degree : {1, 2})
      for (const double radius : {1.5, -1.5})
        {
          SCOPED_TRACE(std::to_string(dim) + "D, degree " + std::to_string(degree) +
                       (method == Method::nodal ? ", nodal" : ", mortar") +
                       (radius > 0. ? ", round" : ", hollow"));
          check(MirrorImages<dim>(radius, degree, method));
        }
}
} // namespace

TEST(MirrorImages, TheClosingOfAGapIsNoSlip)
{
  for_each_pair_of_images<2>(expect_no_slip<2>);
  for_each_pair_of_images<3>(expect_no_slip<3>);
}

/// Without friction, points are paired along the normals of one side.
TEST(MirrorImages, WithoutFrictionNormalsAreThoseOfOneSide)
{
  for_each_pair_of_images<2>([](auto scene) {
    scene.rough.parameters.friction = Friction::none;
    double largest_tilt             = 0.;
    for (const auto &row : scene.contact().rows(scene.positions))
      largest_tilt = std::max(largest_tilt, std::abs(row.normal[0]));
    EXPECT_GT(largest_tilt, 0.2);
  });
}

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <numeric>

#include "row_checks.h"

using namespace snug;
using namespace snug::contact;
using namespace snug::faces;

namespace {
template <int dim>
struct MortarBoxes : public TwoBoxes<dim>
{
  using typename TwoBoxes<dim>::Bodies;
  using typename TwoBoxes<dim>::Field;

  MortarBoxes(const Bodies &bodies, unsigned int degree) : TwoBoxes<dim>(bodies, degree)
  {
    this->method = Method::mortar;
  }

  void shift_slave(double distance)
  {
    for (unsigned int node = 0; node < this->positions.size(); ++node)
      if (!this->is_master(node))
        for (unsigned int d = 0; d < dim; ++d)
          this->positions[node][d] += distance * (1. + 0.6 * d);
  }

  void rotate(const dealii::Tensor<2, dim> &q)
  {
    for (auto &x : this->positions)
      x = q * x;
  }

  /// sum_i force_i c_i on the surface nodes.
  Field nodal_forces(const std::vector<double> &forces) const
  {
    Field      result(this->surface.n_nodes());
    const auto rows = this->contact().rows(this->positions);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (const auto &c : rows[i].coefficients)
        result[c.first] += forces[i] * c.second;
    return result;
  }

  /// int N_a p n of all faces with a pressure p, outward normals n; hanging
  /// nodes give theirs to their masters.
  template <typename Pressure>
  Field consistent_forces(const Pressure &p) const
  {
    const FaceShape<dim>          shape(this->mesh.degree());
    const dealii::QGauss<dim - 1> gauss(5);
    Field                         result(this->surface.n_nodes());
    for (const auto &face : this->surface.faces())
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const auto             values = shape.at(gauss.point(q));
          dealii::Tensor<1, dim> x;
          for (unsigned int k = 0; k < face.nodes.size(); ++k)
            x += values.value[k] * this->positions[face.nodes[k]];
          const auto force = gauss.weight(q) * p(x) *
                             area_vector(tangents<dim>(values, face.nodes, this->positions));
          for (unsigned int k = 0; k < face.nodes.size(); ++k)
            add_resolved(face.nodes[k], values.value[k] * force, result);
        }
    return result;
  }

private:
  void add_resolved(unsigned int node, const dealii::Tensor<1, dim> &value, Field &field) const
  {
    if (this->surface.masters(node).empty())
      field[node] += value;
    for (const auto &master : this->surface.masters(node))
      field[master.first] += master.second * value;
  }
};

template <int dim>
double field_difference(const std::vector<dealii::Tensor<1, dim>> &a,
                        const std::vector<dealii::Tensor<1, dim>> &b)
{
  double worst = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

/// Pressure 1 on faces with hanging nodes that do not match, tilted.
template <int dim>
void expect_uniform_pressure_passes(unsigned int degree)
{
  MortarBoxes<dim> scene(MortarBoxes<dim>::hanging_boxes(), degree);
  scene.rotate(some_rotation<dim>());
  const auto forces = scene.contact().areas(scene.positions);
  EXPECT_LT(field_difference<dim>(scene.nodal_forces(forces),
                                  scene.consistent_forces(
                                    [](const dealii::Tensor<1, dim> &) { return 1.; })),
            1e-13);
}

double linear_pressure(double x)
{
  return 1.7 - 2.3 * x;
}
} // namespace

TEST(MortarRows, UniformPressurePasses)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_uniform_pressure_passes<2>(degree);
      expect_uniform_pressure_passes<3>(degree);
    }
}

TEST(MortarRows, LinearPressurePassesQuadraticFaces)
{
  // int N_j x = x_j int N_j for quadratic functions: linear functions are
  // their own interpolation by multiplier functions
  MortarBoxes<3>      scene(MortarBoxes<3>::boxes(3, 4), 2);
  const auto          contact = scene.contact();
  std::vector<double> forces  = contact.areas(scene.positions);
  for (unsigned int i = 0; i < forces.size(); ++i)
    forces[i] *= linear_pressure(scene.positions[contact.places()[i].slave][0]);
  EXPECT_LT(field_difference<3>(scene.nodal_forces(forces),
                                scene.consistent_forces([](const dealii::Tensor<1, 3> &x) {
                                  return linear_pressure(x[0]);
                                })),
            1e-13);
}

TEST(MortarRows, LinearPressureOnLinearFacesKeepsForceAndMoment)
{
  // slave forces are exact for some p_i; the master side gets the same
  // resultant and moment
  MortarBoxes<3>      scene(MortarBoxes<3>::boxes(3, 4), 1);
  const auto          contact = scene.contact();
  std::vector<double> forces(contact.n_rows());
  const auto          wanted =
    scene.consistent_forces([](const dealii::Tensor<1, 3> &x) { return linear_pressure(x[0]); });
  for (unsigned int i = 0; i < forces.size(); ++i)
    forces[i] = -wanted[contact.places()[i].slave][2];
  const auto got   = scene.nodal_forces(forces);
  double     force = 0., moment = 0., slave_error = 0., master_error = 0.;
  for (unsigned int node = 0; node < got.size(); ++node)
    {
      auto &error = scene.is_master(node) ? master_error : slave_error;
      error       = std::max(error, (got[node] - wanted[node]).norm());
      force += got[node][2];
      moment += got[node][2] * scene.positions[node][0];
    }
  EXPECT_LT(slave_error, 1e-14);
  EXPECT_LT(std::abs(force), 1e-14);
  EXPECT_LT(std::abs(moment), 1e-14);
  EXPECT_GT(master_error, 1e-5); // but not node by node
}

TEST(MortarRows, PartlyCoveredFacesGiveAllPressureToTheMaster)
{
  // the slave side overhangs the master side by part of a face: much, so that
  // it carries multipliers of its own, and hardly
  for (const unsigned int degree : {1, 2})
    for (const double overhang : {0.02, 0.1, 0.17, 0.24})
      {
        auto bodies      = MortarBoxes<3>::boxes(4, 3);
        bodies[0].size   = {1. + overhang, 1.2, 1.};
        bodies[0].corner = {0., -0.1, 1.};
        MortarBoxes<3> scene(bodies, degree);
        const auto     contact = scene.contact();
        const auto     areas   = contact.areas(scene.positions);
        EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.), 1., 1e-13);
        const auto got = scene.nodal_forces(areas);
        const auto wanted =
          scene.consistent_forces([](const dealii::Tensor<1, 3> &) { return 1.; });
        for (unsigned int node = 0; node < got.size(); ++node)
          {
            EXPECT_TRUE(!scene.is_master(node) || (got[node] - wanted[node]).norm() < 1e-12);
          }
        // weights stay moderate
        for (const auto &row : contact.rows(scene.positions))
          for (const auto &c : row.coefficients)
            EXPECT_LT(c.second.norm(), 10.) << overhang;
      }
}

TEST(MortarRows, HeldNodesGiveTheirMultipliersAway)
{
  MortarBoxes<2> scene(MortarBoxes<2>::boxes(4, 3), 1);
  EXPECT_EQ(scene.contact().n_rows(), 5u);
  dealii::Tensor<1, 2> up, sideways;
  up[1] = sideways[0] = 1.;
  for (unsigned int node = 0; node < scene.positions.size(); ++node)
    if (!scene.is_master(node))
      {
        if (scene.positions[node][0] == 0.)
          scene.held[node] = {sideways, up};
        if (scene.positions[node][0] == 1.)
          scene.held[node] = {sideways};
      }
  const auto contact = scene.contact();
  EXPECT_EQ(contact.n_rows(), 4u);
  double total = 0.;
  for (unsigned int i = 0; i < contact.n_rows(); ++i)
    {
      EXPECT_GT(scene.positions[contact.places()[i].slave][0], 0.);
      total += contact.areas(scene.positions)[i];
    }
  EXPECT_NEAR(total, 1., 1e-14);
  const auto shared = contact.dependent_multipliers();
  ASSERT_EQ(shared.size(), 1u);
  EXPECT_EQ(scene.positions[shared[0].node][0], 0.);
  ASSERT_EQ(shared[0].rows.size(), 1u);
  EXPECT_EQ(shared[0].rows[0].second, 1.);
  // to the next of the four faces
  EXPECT_EQ(scene.positions[contact.places()[shared[0].rows[0].first].slave][0], 0.25);
  const auto got    = scene.nodal_forces(contact.areas(scene.positions));
  const auto wanted = scene.consistent_forces([](const dealii::Tensor<1, 2> &) { return 1.; });
  EXPECT_LT(field_difference<2>(got, wanted), 1e-14);
}

TEST(MortarRows, NormalsStayInSymmetryPlanes)
{
  auto bodies            = MortarBoxes<3>::boxes(3, 4);
  bodies[0].curved_faces = {{"bottom", "-(x^2+y^2)/4"}};
  MortarBoxes<3> scene(bodies, 1);
  scene.hold_left();
  const auto   contact = scene.contact();
  const auto   rows    = contact.rows(scene.positions);
  unsigned int n_held  = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (!scene.held[contact.places()[i].slave].empty())
      {
        ++n_held;
        EXPECT_EQ(rows[i].normal[0], 0.);
        EXPECT_NEAR(rows[i].normal.norm(), 1., 1e-15);
      }
  EXPECT_GT(n_held, 3u);
}

TEST(MortarRows, GapOfSphereOverPlaneConverges)
{
  std::vector<double> errors;
  for (const unsigned int n : {4, 8, 16})
    {
      auto bodies            = MortarBoxes<3>::boxes(n, n + 1);
      bodies[0].curved_faces = {{"bottom", "sphere 4"}};
      bodies[1].corner       = {-0.2, -0.2, 0.};
      bodies[1].size         = {1.4, 1.4, 1.};
      const MortarBoxes<3> scene(bodies, 1);
      const auto           contact = scene.contact();
      const auto           rows    = contact.rows(scene.positions);
      double               worst   = 0.;
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          // along the normal of the sphere
          const auto  &x  = scene.positions[contact.places()[i].slave];
          const double dz = 4. - (x[2] - 1.), distance = 4. / dz * 4. - 4.;
          worst = std::max(worst, std::abs(rows[i].gap - distance));
        }
      errors.push_back(worst);
    }
  // of first order: at the edge of the side normals are of one face only
  EXPECT_LT(errors[1], errors[0] / 1.7);
  EXPECT_LT(errors[2], errors[1] / 1.7);
  EXPECT_LT(errors[2], 2e-4);
}

TEST(MortarRows, DerivativesAgreeWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      MortarBoxes<2> plane(MortarBoxes<2>::hanging_boxes(), degree);
      plane.hold_left();
      plane.bend();
      plane.shift_slave(0.013);
      EXPECT_LT(derivative_error(plane, plane.contact(), 1e-5), 1e-8);
      MortarBoxes<3> solid(MortarBoxes<3>::hanging_boxes(), degree);
      solid.hold_left();
      solid.bend();
      solid.shift_slave(0.013);
      EXPECT_LT(derivative_error(solid, solid.contact(), 1e-6), 1e-8);
    }
}

TEST(MortarRows, ReverseModeEqualsDirectionalDerivative)
{
  const double round_off = 1e-12; // of inverse matrices of partly covered faces
  for (const unsigned int degree : {1, 2})
    {
      MortarBoxes<2> plane(MortarBoxes<2>::hanging_boxes(), degree);
      plane.hold_left();
      plane.bend();
      EXPECT_LT(reverse_error(plane, plane.contact()), round_off);
      MortarBoxes<3> solid(MortarBoxes<3>::hanging_boxes(), degree);
      solid.hold_left();
      solid.bend();
      EXPECT_LT(reverse_error(solid, solid.contact()), round_off);
    }
}

TEST(MortarRows, RigidMotionsRotateNormalsAndKeepGaps)
{
  for (const unsigned int degree : {1, 2})
    {
      MortarBoxes<2> plane(MortarBoxes<2>::hanging_boxes(), degree);
      plane.bend();
      expect_invariance(plane);
      MortarBoxes<3> solid(MortarBoxes<3>::hanging_boxes(), degree);
      solid.bend();
      expect_invariance(solid);
    }
}

TEST(MortarRows, LimitsOfThePairHold)
{
  auto bodies            = TwoBoxes<2>::boxes(10, 23);
  bodies[0].curved_faces = {{"bottom", "0.5 * x^2"}};
  bodies[1].corner       = {-1., 0.};
  bodies[1].size         = {3., 1.};
  const TwoBoxes<2> scene(bodies, 1);
  const auto        n_rows = [&](double distance, double angle) {
    Pair pair                       = TwoBoxes<2>::pair();
    pair.parameters.method          = Method::mortar;
    pair.parameters.search_distance = distance;
    pair.parameters.largest_angle   = angle;
    return Contact<2>(scene.surface, {pair}, 1, scene.positions, scene.held).n_rows();
  };
  EXPECT_EQ(n_rows(0., 90.), 11u);
  // about x^2 / 2 at x = 0, 0.1, ...
  EXPECT_EQ(n_rows(0.11, 90.), 5u);
  // slopes of the faces are 0.05, 0.15, ...: six of them
  EXPECT_EQ(n_rows(0., std::atan(0.6) * 180. / dealii::numbers::PI), 7u);
}

TEST(MortarRows, TwoFacesOfABodyShareTheRowsOfTheirEdge)
{
  // a corner that points down, above a wide block with twice as many faces
  auto bodies      = TwoBoxes<2>::boxes(4, 32);
  bodies[1].corner = {-2., 0.};
  bodies[1].size   = {4., 0.9};
  const TwoBoxes<2>      boxes(bodies, 1);
  const mesh::Surface<2> surface(boxes.mesh, {{0, 2}, {0, 0}, {1, 3}});
  auto                   positions = surface.gather(boxes.mesh.reference_positions());
  for (unsigned int node = 0; node < positions.size(); ++node)
    {
      auto &x = positions[node];
      if (x[1] > 0.95)
        x = dealii::Point<2>((x[0] - x[1] + 1.) * std::sqrt(0.5),
                             1. + (x[0] + x[1] - 1.) * std::sqrt(0.5));
    }
  Pair bottom              = TwoBoxes<2>::pair();
  bottom.parameters.method = Method::mortar;
  Pair left                = bottom;
  left.slave               = {0, 0};
  const Contact<2> contact(surface, {bottom, left}, 1, positions,
                           HeldDirections<2>(positions.size()));
  EXPECT_EQ(contact.n_rows(), 5u + 2u - 1u);
  const auto areas = contact.areas(positions);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.), 2., 1e-13);
}

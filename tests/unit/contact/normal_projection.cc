#include <snug/base/errors.h>

#include "row_checks.h"

using namespace snug;
using namespace snug::contact;

namespace {
/// Bent boxes with hanging nodes, whose faces are what contact sees.
template <int dim>
TwoBoxes<dim> facets(unsigned int degree)
{
  TwoBoxes<dim> scene(TwoBoxes<dim>::hanging_boxes(), degree);
  scene.hold_left();
  scene.bend();
  return scene;
}

template <int dim>
TwoBoxes<dim> true_surfaces(unsigned int degree)
{
  return {TwoBoxes<dim>::ball_and_socket(5, 3, 2.), degree};
}

/// Moves all points at random by up to @p size, hanging nodes with their masters.
template <int dim>
void shake(TwoBoxes<dim> &scene, double size)
{
  const auto moves = scene.random_velocity(8);
  for (unsigned int i = 0; i < moves.size(); ++i)
    scene.positions[i] += size * moves[i];
  for (unsigned int node = 0; node < scene.surface.n_nodes(); ++node)
    if (!scene.surface.masters(node).empty())
      {
        scene.positions[node] = 0.;
        for (const auto &master : scene.surface.masters(node))
          scene.positions[node] += master.second * scene.positions[master.first];
      }
}

/// Far from where contact was paired, so that foot points have moved.
template <int dim>
void expect_exact_derivatives(TwoBoxes<dim> scene)
{
  const auto contact = scene.contact();
  shake(scene, 2e-3);
  EXPECT_LT(derivative_error(scene, contact, 1e-5), 1e-8);
  EXPECT_LT(reverse_error(scene, contact), 1e-12);
}

/// The largest change of the factors of the normal.
template <int dim>
double change(const Row<dim> &a, const Row<dim> &b)
{
  double largest = 0.;
  for (unsigned int i = 0; i < a.coefficients.size(); ++i)
    largest = std::max(largest, std::abs(a.coefficients[i].second * a.normal -
                                         b.coefficients[i].second * b.normal));
  return largest;
}

/// Rows whose foot points are still on their faces are those of a new pairing.
template <int dim>
void expect_new_pairing(TwoBoxes<dim> scene)
{
  const auto contact = scene.contact();
  const auto paired  = contact.rows(scene.positions);
  shake(scene, 2e-3);
  const auto rows   = contact.rows(scene.positions);
  const auto drifts = contact.pairing_drifts(scene.positions, rows);
  const auto other  = scene.contact();
  const auto anew   = other.rows(scene.positions);
  ASSERT_EQ(rows.size(), anew.size());
  unsigned int n = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      ASSERT_EQ(contact.places()[i].slave, other.places()[i].slave);
      if (drifts[i] > 1e-12)
        continue;
      ++n;
      ASSERT_EQ(rows[i].coefficients.size(), anew[i].coefficients.size());
      EXPECT_LT(::difference<dim>({rows[i]}, {anew[i]}), 1e-12);
      EXPECT_GT(change(rows[i], paired[i]), 1e-6);
    }
  EXPECT_GT(n, 2u);
}

/// Return whether the master of a row is a single node.
template <int dim>
bool is_node_to_node(const Row<dim> &row)
{
  return row.coefficients.size() == 2 &&
         std::abs(row.coefficients[0].second * row.coefficients[1].second + 1.) < 1e-14;
}
} // namespace

TEST(NormalProjection, DerivativesWhereItHasMoved)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_exact_derivatives(facets<2>(degree));
      expect_exact_derivatives(facets<3>(degree));
      expect_exact_derivatives(true_surfaces<2>(degree));
      expect_exact_derivatives(true_surfaces<3>(degree));
    }
}

TEST(NormalProjection, OnItsFaceItIsThatOfANewPairing)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_new_pairing(facets<2>(degree));
      expect_new_pairing(facets<3>(degree));
      expect_new_pairing(true_surfaces<2>(degree));
      expect_new_pairing(true_surfaces<3>(degree));
    }
}

TEST(NormalProjection, OnANodeItStays)
{
  for (const unsigned int degree : {1, 2})
    {
      TwoBoxes<3> scene(TwoBoxes<3>::boxes(4, 4), degree);
      const auto  contact = scene.contact();
      shake(scene, 0.02);
      const auto velocity = scene.random_velocity(2);
      const auto slopes   = contact.row_derivatives(scene.positions, velocity);
      const auto rows     = contact.rows(scene.positions);
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          EXPECT_TRUE(is_node_to_node(rows[i]));
          EXPECT_FALSE(rows[i].off_face);
          for (const auto &c : slopes[i].coefficients)
            EXPECT_EQ((c.second.norm_square()), slopes[i].normal.norm_square());
        }
    }
}

/// Meshes that match along x: foot points stay on the lines of nodes and follow along these.
TEST(NormalProjection, OnAnEdgeItFollowsAlongIt)
{
  auto bodies        = TwoBoxes<3>::boxes(4, 3);
  bodies[1].cells[0] = 4;
  TwoBoxes<3> scene(bodies, 1);
  const auto  contact = scene.contact();
  const auto  paired  = contact.rows(scene.positions);
  shake(scene, 5e-3);
  EXPECT_LT(derivative_error(scene, contact, 1e-5), 1e-8);
  EXPECT_LT(reverse_error(scene, contact), 1e-12);
  const auto   rows  = contact.rows(scene.positions);
  unsigned int n_two = 0, n_moved = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const auto &x = scene.surface.reference_positions();
      for (const auto &c : rows[i].coefficients)
        EXPECT_LT(std::abs(x[c.first][0] - x[contact.places()[i].slave][0]), 0.2);
      n_two += rows[i].coefficients.size() == 3;
      n_moved += change(rows[i], paired[i]) > 1e-4;
    }
  EXPECT_GE(n_two, 10u);
  EXPECT_GE(n_moved, 10u);
}

TEST(NormalProjection, BeyondTheSideItStays)
{
  auto bodies         = TwoBoxes<2>::boxes(6, 4);
  bodies[0].corner[0] = -0.26;
  bodies[0].size[0]   = 1.5;
  TwoBoxes<2> scene(bodies, 1);
  const auto  contact = scene.contact();
  const auto  paired  = contact.rows(scene.positions);
  for (const auto &place : contact.places())
    scene.positions[place.slave][0] += 0.01;
  const auto   rows = contact.rows(scene.positions);
  unsigned int n    = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (paired[i].gap > 0.)
      {
        ++n;
        EXPECT_TRUE(is_node_to_node(rows[i]));
        EXPECT_EQ(rows[i].gap, paired[i].gap);
      }
  EXPECT_EQ(n, 1u);
}

TEST(NormalProjection, DriftIsTheWayOffTheFace)
{
  // slave nodes at 0.1, 0.9, 0.7, 0.5 and 0.3 of master faces
  auto bodies         = TwoBoxes<2>::boxes(4, 4);
  bodies[0].corner[0] = 0.025;
  bodies[0].size[0]   = 0.8;
  for (const double shift : {-0.2, 0.3})
    {
      TwoBoxes<2> scene(bodies, 1);
      const auto  contact = scene.contact();
      for (const auto &place : contact.places())
        scene.positions[place.slave] += 0.25 * shift * dealii::Point<2>(1., 0.);
      const auto drifts = contact.pairing_drifts(scene.positions, contact.rows(scene.positions));
      for (unsigned int i = 0; i < drifts.size(); ++i)
        {
          const double x  = scene.surface.reference_positions()[contact.places()[i].slave][0];
          const double xi = std::fmod(x, 0.25) / 0.25 + shift;
          EXPECT_NEAR(drifts[i], std::max({0., -xi, xi - 1.}), 1e-12) << x;
        }
    }
}

TEST(NormalProjection, FarOffItsFaceIsTangled)
{
  for (const double shift : {0.24, 0.5})
    {
      TwoBoxes<2> scene(TwoBoxes<2>::boxes(3, 4), 1);
      const auto  contact = scene.contact();
      for (const auto &place : contact.places())
        scene.positions[place.slave][0] += shift;
      if (shift < 0.25)
        EXPECT_NO_THROW(contact.rows(scene.positions));
      else
        EXPECT_THROW(contact.rows(scene.positions), TangledMesh);
    }
}

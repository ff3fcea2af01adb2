#include <gtest/gtest.h>

#include "row_checks.h"

using namespace snug;
using namespace snug::contact;

namespace {
template <int dim>
void expect_exact_derivatives(unsigned int degree)
{
  TwoBoxes<dim> scene(TwoBoxes<dim>::hanging_boxes(), degree);
  scene.hold_left();
  scene.bend();
  const auto contact = scene.contact();
  // the step is 2e-4 of a Q2 node distance: truncation ~ (2e-4)^4, round-off
  // ~ 1e-16 / 1e-5
  EXPECT_LT(derivative_error(scene, contact, 1e-5), 1e-9);
  EXPECT_LT(reverse_error(scene, contact), 1e-13);
}
} // namespace

TEST(NodalRows, GapOfSphereOverPlaneIsItsHeight)
{
  auto bodies            = TwoBoxes<3>::boxes(4, 4);
  bodies[0].curved_faces = {{"bottom", "sphere 4"}};
  const TwoBoxes<3> scene(bodies, 1);
  const auto        contact = scene.contact();
  const auto        rows    = contact.rows(scene.positions);
  ASSERT_EQ(rows.size(), 25u);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const auto  &x  = scene.positions[contact.places()[i].slave];
      const double r2 = std::pow(x[0] - 0.5, 2) + std::pow(x[1] - 0.5, 2);
      EXPECT_NEAR(rows[i].gap, 4. - std::sqrt(16. - r2), 1e-14);
      // from the slave above into the master below
      EXPECT_NEAR(rows[i].normal[2], -1., 1e-14);
      ASSERT_EQ(rows[i].coefficients.size(), 2u);
      for (const auto &c : rows[i].coefficients)
        EXPECT_NEAR(c.second[2], c.first == contact.places()[i].slave ? -1. : 1., 1e-14);
    }
}

TEST(NodalRows, GapOfPlaneOverCurvedMasterConverges)
{
  // slave plane 0.2 above the summit of a sphere of radius 3 meshed by Q1: the
  // distance to the sphere is |x - c| - R, c = (0.5, 0.5, 1 - R); the faces
  // leave it by O(h^2)
  std::vector<double> errors;
  for (const unsigned int n : {4, 8, 16})
    {
      auto bodies            = TwoBoxes<3>::boxes(3, n);
      bodies[0].corner       = {0.25, 0.25, 1.2};
      bodies[0].size         = {0.5, 0.5, 1.};
      bodies[1].curved_faces = {{"top", "sphere 3"}};
      const TwoBoxes<3> scene(bodies, 1);
      const auto        contact = scene.contact();
      const auto        rows    = contact.rows(scene.positions);
      EXPECT_EQ(rows.size(), 16u);
      double worst = 0.;
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          const dealii::Point<3> centre(0.5, 0.5, -2.);
          const double distance = (scene.positions[contact.places()[i].slave] - centre).norm() - 3.;
          worst                 = std::max(worst, std::abs(rows[i].gap - distance));
        }
      errors.push_back(worst);
    }
  EXPECT_LT(errors[1], errors[0] / 3.);
  EXPECT_LT(errors[2], errors[1] / 3.);
  EXPECT_LT(errors[2], 1e-3);
}

TEST(NodalRows, NormalsStayInSymmetryPlanes)
{
  // one-sided means of the faces at x = 0 lean by half the angle between faces
  auto bodies            = TwoBoxes<3>::boxes(4, 3);
  bodies[1].curved_faces = {{"top", "-(x^2+y^2)/4"}};
  TwoBoxes<3> scene(bodies, 1);
  scene.hold_left();
  const auto   contact = scene.contact();
  const auto   rows    = contact.rows(scene.positions);
  unsigned int n_held  = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (scene.positions[contact.places()[i].slave][0] == 0.)
      {
        ++n_held;
        EXPECT_EQ(rows[i].normal[0], 0.);
        EXPECT_NEAR(rows[i].normal.norm(), 1., 1e-15);
      }
  EXPECT_GT(n_held, 3u);
}

TEST(NodalRows, HangingNodesAreReplacedAndLinearFieldsReproduced)
{
  for (const unsigned int degree : {1, 2})
    {
      TwoBoxes<3> scene(TwoBoxes<3>::hanging_boxes(), degree);
      scene.bend();
      const auto   projections = scene.projections();
      const auto   contact     = scene.contact();
      unsigned int n_replaced  = 0;
      const auto   rows        = contact.rows(scene.positions);
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          double gap = 0.;
          for (const auto &c : rows[i].coefficients)
            {
              EXPECT_TRUE(scene.surface.masters(c.first).empty());
              gap -= c.second * scene.positions[c.first];
            }
          // hanging positions follow their masters, so the coefficients
          // without hanging nodes give the same gap, but for that of the edge
          EXPECT_NEAR(gap + projections[i].softening, rows[i].gap, 1e-13);
          for (const auto &master : projections[i].masters)
            n_replaced += !scene.surface.masters(master.first).empty();
        }
      EXPECT_GT(n_replaced, 0u);
    }
}

TEST(NodalRows, DerivativesAgreeWithFiniteDifferencesAndReverseMode)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_exact_derivatives<2>(degree);
      expect_exact_derivatives<3>(degree);
    }
}

TEST(NodalRows, RigidMotionsRotateNormalsAndKeepGaps)
{
  for (const unsigned int degree : {1, 2})
    {
      TwoBoxes<2> plane(TwoBoxes<2>::hanging_boxes(), degree);
      plane.bend();
      expect_invariance(plane);
      TwoBoxes<3> solid(TwoBoxes<3>::hanging_boxes(), degree);
      solid.bend();
      expect_invariance(solid);
    }
}

TEST(NodalRows, FoldedFaceIsTangled)
{
  TwoBoxes<3> scene(TwoBoxes<3>::boxes(2, 2), 1);
  const auto  contact = scene.contact();
  for (auto &x : scene.positions)
    x[0] = 0.;
  EXPECT_THROW(contact.rows(scene.positions), TangledMesh);
}

TEST(NodalRows, AreasAreTributary)
{
  const TwoBoxes<2> line(TwoBoxes<2>::boxes(1, 1), 2);
  const auto        contact = line.contact();
  const auto        areas   = contact.areas(line.positions);
  for (unsigned int i = 0; i < 3; ++i)
    {
      const double x = line.positions[contact.places()[i].slave][0];
      EXPECT_NEAR(areas[i], std::abs(x - 0.5) < 0.1 ? 4. / 6 : 1. / 6, 1e-14);
    }
  for (const unsigned int degree : {1, 2})
    {
      // hanging slave nodes give their share away: nothing is lost
      const TwoBoxes<3> scene(TwoBoxes<3>::hanging_boxes(), degree);
      double            total = 0.;
      for (const double area : scene.contact().areas(scene.positions))
        total += area;
      EXPECT_NEAR(total, 1., 1e-13);
    }
}

TEST(NodalRows, DoNotDependOnRanks)
{
  for (const unsigned int degree : {1, 2})
    {
      const auto  bodies = TwoBoxes<3>::hanging_boxes();
      TwoBoxes<3> all(bodies, degree, MPI_COMM_WORLD);
      TwoBoxes<3> self(bodies, degree, MPI_COMM_SELF);
      all.bend();
      self.bend();
      const auto contact = all.contact(), own = self.contact();
      const auto rows = contact.rows(all.positions);
      const auto one  = own.rows(self.positions);
      const auto a    = contact.areas(all.positions);
      const auto b    = own.areas(self.positions);
      ASSERT_EQ(rows.size(), one.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          const unsigned int p = contact.places()[i].slave;
          const unsigned int q = own.places()[i].slave;
          EXPECT_NEAR((all.positions[p] - self.positions[q]).norm(), 0., 1e-14);
          EXPECT_EQ(rows[i].coefficients.size(), one[i].coefficients.size());
          EXPECT_NEAR(rows[i].gap, one[i].gap, 1e-13);
          EXPECT_NEAR((rows[i].normal - one[i].normal).norm(), 0., 1e-12);
          EXPECT_NEAR(a[i], b[i], 1e-14);
        }
    }
}

#include "row_checks.h"

using namespace snug;
using namespace snug::contact;

namespace {
/// A ball of radius 2 under a socket of radius 2.1 whose poles touch.
template <int dim>
struct Socket : public TwoBoxes<dim>
{
  Socket(unsigned int n_slave, unsigned int n_master, unsigned int degree, Method used_method)
    : TwoBoxes<dim>(TwoBoxes<dim>::ball_and_socket(n_slave, n_master, 2.), degree)
  {
    this->method = used_method;
  }

  /// Distance of the spheres from @p x on the socket along the normal of the ball.
  static double gap(const dealii::Tensor<1, dim> &x)
  {
    dealii::Tensor<1, dim> from_centre = x;
    for (unsigned int d = 0; d < dim - 1; ++d)
      from_centre[d] -= 0.5;
    from_centre[dim - 1] -= 1. - 2.;
    return from_centre.norm() - 2.;
  }
};

/// Derivatives where nodes and samples of both sides have moved at random.
template <int dim>
void expect_derivatives(Method method, unsigned int degree)
{
  Socket<dim> scene(5, 3, degree, method);
  ASSERT_GT(scene.surface.n_points(), scene.surface.n_nodes());
  const auto moves = scene.random_velocity(3);
  for (unsigned int i = 0; i < moves.size(); ++i)
    scene.positions[i] += 2e-3 * moves[i];
  const auto contact = scene.contact();
  // of fourth order: (h / face)^4 against rounding / h
  EXPECT_LT(derivative_error(scene, contact, 1e-5), 3e-8) << to_text(method) << degree << dim;
  EXPECT_LT(reverse_error(scene, contact), 1e-12) << to_text(method) << degree << dim;
}
} // namespace

TEST(TrueSurfaces, DerivativesByNodesAndSamples)
{
  for (const auto method : {Method::nodal, Method::mortar})
    for (const unsigned int degree : {1, 2})
      {
        expect_derivatives<2>(method, degree);
        expect_derivatives<3>(method, degree);
      }
}

TEST(TrueSurfaces, NodalGapsAreThoseOfTheSpheres)
{
  const auto expect_gaps = [](const auto &scene) {
    const auto contact = scene.contact();
    const auto rows    = contact.rows(scene.positions);
    for (unsigned int i = 0; i < rows.size(); ++i)
      // Polynomials of degree 4 over faces of 1/4 on a radius of 2.
      EXPECT_NEAR(rows[i].gap, scene.gap(scene.positions[contact.places()[i].slave]), 1e-7);
  };
  for (const unsigned int degree : {1, 2})
    {
      expect_gaps(Socket<2>(5, 4, degree, Method::nodal));
      expect_gaps(Socket<3>(5, 4, degree, Method::nodal));
    }
}

/// Means of a gap of 0 to 0.006 over faces: facets alone are off by their heights, up to 0.008.
TEST(TrueSurfaces, MortarGapsAreMeansOfThoseOfTheSpheres)
{
  const auto expect_gaps = [](const auto &scene, double tolerance) {
    const auto contact = scene.contact();
    const auto rows    = contact.rows(scene.positions);
    double     worst   = 0.;
    for (unsigned int i = 0; i < rows.size(); ++i)
      worst = std::max(worst, std::abs(rows[i].gap -
                                       scene.gap(scene.positions[contact.places()[i].slave])));
    // The mean over the faces at a node is not the value there.
    EXPECT_LT(worst, tolerance);
  };
  expect_gaps(Socket<2>(8, 6, 1, Method::mortar), 2e-4);
  expect_gaps(Socket<3>(8, 6, 1, Method::mortar), 4e-4);
}

namespace {
/// A full pin in a full plate, or a ball in a shell, whose meshes do not match.
template <int dim>
struct Round
{
  using Bodies = std::vector<geometry::BodyMeshParameters>;

  static Bodies bodies(unsigned int n_pin, unsigned int n_plate)
  {
    Bodies result(2);
    for (unsigned int b = 0; b < 2; ++b)
      {
        result[b].source             = dim == 2 ? geometry::Source::ring : geometry::Source::shell;
        result[b].inner_radius       = b == 0 ? 0.5 : 1.01;
        result[b].radius             = b == 0 ? 1. : 2.;
        result[b].round_cells        = {b == 0 ? n_pin : n_plate, 1};
        result[b].sampled_boundaries = {b == 0 ? "outer" : "inner"};
        // Off the origin and turned, so that nothing is round by its digits alone.
        result[b].rotate = {{"z", "17"}};
        result[b].shift  = std::vector<double>(dim, 0.3);
      }
    return result;
  }

  Round(unsigned int n_pin, unsigned int n_plate, unsigned int degree)
    : mesh(MPI_COMM_WORLD, bodies(n_pin, n_plate), degree)
    , surface(mesh, {side(0, "outer"), side(1, "inner")})
  {}

  Boundary side(unsigned int body, const std::string &name) const
  {
    return {body, geometry::boundary_index(mesh.geometry(body), name)};
  }

  /// The largest moment of a row's forces on the pin about the common centre, for a unit force.
  double largest_moment(Method method) const
  {
    Pair pair{side(0, "outer"), side(1, "inner"), "pin", "plate"};
    pair.parameters.method = method;
    const Contact<dim>     contact(surface, {pair}, mesh.degree(), surface.reference_positions(),
                                   faces::HeldDirections<dim>(surface.n_nodes()));
    dealii::Tensor<1, dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = 0.3;
    double largest = 0.;
    for (const auto &row : contact.rows(surface.reference_positions()))
      for (const unsigned int body : {0, 1})
        {
          dealii::Tensor<1, 3> moment;
          for (const auto &[node, force] : row.coefficients)
            if (is_of(body, node))
              moment += cross_product_3d(in_space(surface.reference_positions()[node] - centre),
                                         in_space(force));
          largest = std::max(largest, moment.norm());
        }
    return largest;
  }

  static dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, dim> &v)
  {
    dealii::Tensor<1, 3> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = v[d];
    return result;
  }

  bool is_of(unsigned int body, unsigned int node) const
  {
    return mesh.body_of_node(mesh.local_node(surface.global_node(node))) == body;
  }

  mesh::BodyMesh<dim> mesh;
  mesh::Surface<dim>  surface;
};
} // namespace

/// From the slave along its own normal, as the rows have it, to the sphere of the master.
TEST(TrueSurfaces, PointGapsOfMortarPairsAreAlongTheNormalsOfTheSlave)
{
  const auto expect_gaps = [](const auto &scene) {
    const auto contact = scene.contact();
    const auto gaps    = contact.point_gaps(0, scene.positions, scene.held);
    const auto rows    = contact.rows(scene.positions);
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const unsigned int slave = contact.places()[i].slave;
        const auto         gap =
          gaps->at(scene.positions[slave], {{slave, 1.}}, contact.pairs()[0].slave.boundaries()[0]);
        ASSERT_TRUE(gap);
        EXPECT_LT((gap->normal - rows[i].normal).norm(), 1e-12);
        EXPECT_NEAR(scene.gap(scene.positions[slave] + gap->gap * gap->normal), 0., 1e-7);
      }
  };
  for (const unsigned int degree : {1, 2})
    {
      expect_gaps(Socket<2>(5, 4, degree, Method::mortar));
      expect_gaps(Socket<3>(5, 4, degree, Method::mortar));
    }
}

/// Facets would give moments of 1e-3 to 1e-2; each of the bodies has none by itself.
TEST(TrueSurfaces, RoundBodiesTurnFreely)
{
  int n_ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks > 1)
    GTEST_SKIP() << "nodes of both bodies are asked for on one rank";
  for (const auto method : {Method::nodal, Method::mortar})
    for (const unsigned int degree : {1, 2})
      {
        EXPECT_LT(Round<2>(12, 15, degree).largest_moment(method), 1e-14) << degree;
        EXPECT_LT(Round<2>(31, 20, degree).largest_moment(method), 1e-14) << degree;
      }
  EXPECT_LT(Round<3>(2, 3, 1).largest_moment(Method::nodal), 1e-14);
  EXPECT_LT(Round<3>(2, 3, 1).largest_moment(Method::mortar), 1e-14);
}

/// Cells that are refined unevenly: their samples lie beside the points of the faces with the same
/// coordinates, but faces of a plane are not off it, and chords of an arc by their sagitta.
TEST(TrueSurfaces, HeightsOfFacesAreMeasuredAlongTheirNormals)
{
  for (const double grading : {1., 1e3})
    for (const bool is_round : {false, true})
      {
        geometry::BodyMeshParameters box;
        box.cells              = {6, 2};
        box.grading            = {grading, 1.};
        box.sampled_boundaries = {"top"};
        box.is_designed        = true; // planes as well
        if (is_round)
          box.curved_faces = {{"top", "cylinder z 3"}};
        const mesh::BodyMesh<2>   mesh(MPI_COMM_WORLD, {box}, 1);
        const mesh::Surface<2>    surface(mesh, {{0, 3}});
        const faces::FaceShape<2> shape(1);
        double                    width = 0.;
        for (const auto &face : surface.faces())
          {
            ASSERT_FALSE(face.samples.empty());
            const auto &x = surface.reference_positions();
            width         = std::max(width, (x[face.nodes[1]] - x[face.nodes[0]]).norm());
          }
        const double height = face_height<2>(surface, shape, {0, 3});
        if (!is_round)
          EXPECT_EQ(height, 0.) << grading;
        else
          // samples are next to the middle where cells are not graded, and never above it
          EXPECT_NEAR(height, 3. - std::sqrt(9. - width * width / 4.),
                      (grading > 1. ? 0.3 : 1e-2) * height);
      }
}

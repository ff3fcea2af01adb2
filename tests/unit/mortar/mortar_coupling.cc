#include <snug/mesh/lagrange.h>
#include <snug/mortar/mortar_coupling.h>

#include <gtest/gtest.h>

#include <random>

using namespace snug;
using namespace snug::faces;
using namespace snug::mortar;

namespace {
std::mt19937 generator(3);

double uniform(double bound)
{
  return std::uniform_real_distribution<double>(-bound, bound)(generator);
}

/// A slave face and master faces above it, all curved, the slave face
/// covered in part: nodes in the plane moved by @p noise, and offsets of the
/// true surfaces of the same size on the slave and the first master face.
template <int dim>
struct Faces
{
  MortarFace<dim, double>              slave;
  std::vector<MortarFace<dim, double>> masters;

  explicit Faces(unsigned int degree, double noise)
  {
    slave   = {face(degree, {0., 0., 1., 1.}, false, noise), offsets(noise)};
    masters = {{face(degree, {-0.43, 0.25, 0.52, 1.37}, true, noise), offsets(noise)},
               {face(degree, {0.52, 0.25, 1.3, 1.37}, true, noise), {}},
               {face(degree, {-0.43, -0.6, 0.52, 0.25}, true, noise), {}}};
  }

  static FaceNodes<dim, double> offsets(double noise)
  {
    FaceNodes<dim, double> result(dim == 2
                                    ? mesh::surface_degree + 1
                                    : (mesh::surface_degree + 1) * (mesh::surface_degree + 1));
    for (auto &offset : result)
      for (double &x : offset)
        x = uniform(noise);
    return result;
  }

  /// Corners x_0, y_0, x_1, y_1 in the plane.
  static FaceNodes<dim, double>
  face(unsigned int degree, const std::vector<double> &box, bool facing_down, double noise)
  {
    FaceNodes<dim, double> nodes;
    for (unsigned int j = 0; j <= (dim == 3 ? degree : 0); ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        {
          double s = double(i) / degree;
          if (facing_down)
            s = 1. - s;
          const double            t = double(j) / degree;
          std::array<double, dim> x{};
          x[0]       = box[0] + s * (box[2] - box[0]) + uniform(noise);
          x[dim - 2] = dim == 3 ? box[1] + t * (box[3] - box[1]) + uniform(noise) : x[0];
          x[dim - 1] = (facing_down ? 0.1 : 0.) + uniform(noise);
          nodes.push_back(x);
        }
    return nodes;
  }

  /// All coordinates, one after the other; the same order in velocities.
  std::vector<double> coordinates() const
  {
    std::vector<double> result;
    const auto          add = [&](const MortarFace<dim, double> &face) {
      for (const auto *points : {&face.nodes, &face.offsets})
        for (const auto &point : *points)
          result.insert(result.end(), point.begin(), point.end());
    };
    add(slave);
    for (const auto &master : masters)
      add(master);
    return result;
  }

  void move(double factor, const std::vector<double> &velocity)
  {
    unsigned int next = 0;
    const auto   add  = [&](MortarFace<dim, double> &face) {
      for (auto *points : {&face.nodes, &face.offsets})
        for (auto &point : *points)
          for (double &x : point)
            x += factor * velocity[next++];
    };
    add(slave);
    for (auto &master : masters)
      add(master);
  }
};

std::vector<double> random_vector(std::size_t n)
{
  std::vector<double> v;
  for (std::size_t i = 0; i < n; ++i)
    v.push_back(uniform(1.));
  return v;
}

/// Return the entries of the coupling of @p integrals, and the weights of the corrections.
template <typename Number>
std::vector<Number> entries(const FaceIntegrals<Number> &integrals,
                            const MultiplierFunctions   &functions)
{
  const auto          coupling = couple(integrals, functions);
  std::vector<Number> result   = coupling.multiplier;
  const auto          add      = [&](const dealii::Table<2, Number> &m) {
    for (unsigned int i = 0; i < m.n_rows(); ++i)
      for (unsigned int j = 0; j < m.n_cols(); ++j)
        result.push_back(m(i, j));
  };
  add(coupling.multiplier_slave);
  for (const auto &m : coupling.multiplier_master)
    add(m);
  add(coupling.multiplier_offset);
  for (const auto &m : integrals.weights)
    add(m);
  return result;
}

/// The gradient by the integrals where that by the entries is @p values.
template <int dim>
FaceIntegrals<double> by_integrals(const std::vector<double>   &values,
                                   const FaceIntegrals<double> &integrals,
                                   const MultiplierFunctions   &functions)
{
  const auto numbers = to_numbers(integrals);
  auto       next    = numbers.begin();
  Recording  recording;
  auto       variables =
    zero_integrals<dim, Recorded>(integrals.slave.size(), integrals.slave_master.size());
  for_each_number(variables, [&](Recorded &number) { number = recording.variable(*next++); });
  const auto results = entries(variables, functions);
  for (unsigned int i = 0; i < results.size(); ++i)
    recording.add(results[i], values[i]);
  recording.sweep();
  std::vector<double> slopes;
  for_each_number(variables,
                  [&](const Recorded &number) { slopes.push_back(recording.derivative(number)); });
  return from_numbers<dim, double>(integrals.slave.size(), integrals.slave_master.size(),
                                   slopes.begin());
}

template <int dim>
SegmentQuadrature<dim> rule(unsigned int degree)
{
  return {degree, mesh::Idealization::natural(dim)};
}

/// Entries of the coupling, differentiated along @p velocity by differences
/// of fourth order.
template <int dim>
std::vector<double> differences(unsigned int               degree,
                                const Faces<dim>          &faces,
                                const std::vector<double> &velocity,
                                const MultiplierFunctions &functions)
{
  const double        h = 1e-4;
  std::vector<double> slope;
  for (const auto &term : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
    {
      Faces<dim> moved = faces;
      moved.move(term.first * h, velocity);
      const auto values =
        entries(integrate<dim>(rule<dim>(degree), moved.slave, moved.masters), functions);
      slope.resize(values.size(), 0.);
      for (unsigned int i = 0; i < values.size(); ++i)
        slope[i] += term.second / (12. * h) * values[i];
    }
  return slope;
}

template <int dim>
MortarFace<dim, Differential<1>>
moving(const MortarFace<dim, double> &face, const std::vector<double> &velocity, unsigned int &next)
{
  const auto move = [&](const FaceNodes<dim, double> &points) {
    FaceNodes<dim, Differential<1>> result(points.size());
    for (unsigned int k = 0; k < points.size(); ++k)
      for (int i = 0; i < dim; ++i)
        {
          result[k][i]          = points[k][i];
          result[k][i].slope[0] = velocity[next++];
        }
    return result;
  };
  // Braced, so that the nodes come first.
  return {move(face.nodes), move(face.offsets)};
}

/// Nodes and offsets of a face as variables, which are added to @p all in the order of
/// coordinates().
template <int dim>
MortarFace<dim, Recorded>
recorded(const MortarFace<dim, double> &face, Recording &recording, std::vector<Recorded> &all)
{
  const auto record = [&](const FaceNodes<dim, double> &points) {
    FaceNodes<dim, Recorded> result(points.size());
    for (unsigned int k = 0; k < points.size(); ++k)
      for (int i = 0; i < dim; ++i)
        all.push_back(result[k][i] = recording.variable(points[k][i]));
    return result;
  };
  // Braced, so that the nodes come first.
  return {record(face.nodes), record(face.offsets)};
}

template <int dim>
std::vector<double> exact_derivative(unsigned int               degree,
                                     const Faces<dim>          &faces,
                                     const std::vector<double> &velocity,
                                     const MultiplierFunctions &functions)
{
  unsigned int                                  next  = 0;
  const auto                                    slave = moving<dim>(faces.slave, velocity, next);
  std::vector<MortarFace<dim, Differential<1>>> masters;
  for (const auto &master : faces.masters)
    masters.push_back(moving<dim>(master, velocity, next));
  const auto          quadrature = rule<dim>(degree);
  std::vector<double> slope;
  for (const auto &entry : entries(integrate<dim>(quadrature, slave, masters), functions))
    slope.push_back(entry.slope[0]);
  return slope;
}

/// Standard, biorthogonal and such on a part of the face.
template <int dim>
std::vector<MultiplierFunctions> all_functions(unsigned int degree)
{
  CoverBox<dim> box;
  box.lower.fill(0.005);
  box.upper.fill(0.7);
  return {{false, {}, {}}, {}, functions_on<dim>(box, degree, 0.01)};
}

template <int dim>
void expect_derivatives(unsigned int degree, const MultiplierFunctions &functions)
{
  const Faces<dim> faces(degree, 0.04);
  const auto       velocity = random_vector(faces.coordinates().size());
  const auto       exact    = exact_derivative(degree, faces, velocity, functions);
  const auto       numbers  = differences(degree, faces, velocity, functions);
  ASSERT_EQ(exact.size(), numbers.size());
  double largest = 0., error = 0.;
  for (unsigned int i = 0; i < exact.size(); ++i)
    {
      largest = std::max(largest, std::abs(exact[i]));
      error   = std::max(error, std::abs(exact[i] - numbers[i]));
    }
  EXPECT_LT(error, 1e-8 * largest) << dim << "D, degree " << degree;

  // the transpose: of random weights on the entries
  const auto            quadrature = rule<dim>(degree);
  const auto            integrals  = integrate<dim>(quadrature, faces.slave, faces.masters);
  const auto            weights    = random_vector(exact.size());
  Recording             recording;
  std::vector<Recorded> variables;
  const auto            slave = recorded<dim>(faces.slave, recording, variables);
  std::vector<MortarFace<dim, Recorded>> masters;
  for (const auto &master : faces.masters)
    masters.push_back(recorded<dim>(master, recording, variables));
  add_integral_derivatives(quadrature, slave, masters,
                           by_integrals<dim>(weights, integrals, functions), recording);
  recording.sweep();
  double direct = 0., transposed = 0.;
  for (unsigned int i = 0; i < exact.size(); ++i)
    direct += weights[i] * exact[i];
  for (unsigned int i = 0; i < variables.size(); ++i)
    transposed += recording.derivative(variables[i]) * velocity[i];
  EXPECT_NEAR(direct, transposed, 1e-11 * largest * exact.size());
}
} // namespace

TEST(FaceMap, CoordinatesAreFoundAgain)
{
  for (const unsigned int degree : {1, 2})
    for (unsigned int trial = 0; trial < 20; ++trial)
      {
        const auto nodes = Faces<3>::face(degree, {0., 0., 1., 1.}, false, 0.1);
        std::vector<FaceCoordinates<3, double>> plane;
        for (const auto &node : nodes)
          plane.push_back({{node[0], node[1]}});
        const PlaneFace<3, double>       face(degree, plane);
        const FaceCoordinates<3, double> xi = {{0.5 + uniform(0.5), 0.5 + uniform(0.5)}};
        const FaceValues<3, double>      shape(degree, xi);
        FaceCoordinates<3, double>       y{};
        for (unsigned int k = 0; k < nodes.size(); ++k)
          for (int a = 0; a < 2; ++a)
            y[a] += shape.value[k] * plane[k][a];
        const auto found = face.coordinates(y);
        EXPECT_NEAR(found[0], xi[0], 1e-12);
        EXPECT_NEAR(found[1], xi[1], 1e-12);
      }
}

TEST(MortarCoupling, MultipliersSumToOneAndAreBiorthogonal)
{
  for (const unsigned int degree : {1, 2})
    for (const auto &functions : all_functions<3>(degree))
      {
        const Faces<3>     faces(degree, 0.03);
        const auto         quadrature = rule<3>(degree);
        const auto         integrals  = integrate<3>(quadrature, faces.slave, faces.masters);
        const auto         result     = couple(integrals, functions);
        const unsigned int n          = faces.slave.nodes.size();
        for (unsigned int l = 0; l < n; ++l)
          {
            double on_slave = 0., on_master = 0.;
            for (unsigned int j = 0; j < n; ++j)
              {
                on_slave += result.multiplier_slave(j, l);
                on_master += result.multiplier_master[0](j, l);
                EXPECT_TRUE(!functions.are_nodal() || j == l ||
                            result.multiplier_slave(j, l) == 0.);
              }
            // sum_j int psi_j N = int N
            EXPECT_NEAR(on_slave, integrals.slave[l], 1e-14);
            double of_master = 0.;
            for (unsigned int j = 0; j < n; ++j)
              of_master += integrals.slave_master[0](j, l);
            EXPECT_NEAR(on_master, of_master, 1e-12);
          }
        // a translation of both sides: sum_k int psi_j N_k = int psi_j
        for (unsigned int j = 0; j < n; ++j)
          {
            double sum = 0.;
            for (const auto &M : result.multiplier_master)
              for (unsigned int k = 0; k < n; ++k)
                sum += M(j, k);
            EXPECT_NEAR(sum, result.multiplier[j], 1e-12);
          }
      }
}

TEST(MortarCoupling, CoveredAreaIsExact)
{
  for (const unsigned int degree : {1, 2})
    {
      const Faces<3> plane(degree, 0.);
      double         area = 0.;
      for (const double d : integrate<3>(rule<3>(degree), plane.slave, plane.masters).slave)
        area += d;
      // all of the unit square but its lower right part
      EXPECT_NEAR(area, 1. - 0.48 * 0.25, 1e-14);
      const Faces<2> line(degree, 0.);
      double         length = 0.;
      for (const double d : integrate<2>(rule<2>(degree), line.slave, line.masters).slave)
        length += d;
      // the third master covers the first again
      EXPECT_NEAR(length, 1. + 0.52, 1e-14);
    }
}

TEST(MortarCoupling, DerivativesAgreeWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      for (const auto &functions : all_functions<2>(degree))
        expect_derivatives<2>(degree, functions);
      for (const auto &functions : all_functions<3>(degree))
        expect_derivatives<3>(degree, functions);
    }
}

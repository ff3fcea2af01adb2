#ifndef snug_mortar_mortar_coupling_h
#define snug_mortar_mortar_coupling_h

#include <snug/mesh/body_mesh.h>
#include <snug/mesh/lagrange.h>
#include <snug/mortar/segment_points.h>

#include <deal.II/base/table.h>

namespace snug::mortar {
/**
 * Integrals over the covered part of a slave face, the part opposite to
 * the given master faces, of its shape functions N_j and those of the
 * master faces, N_k, and of the offset between the true surfaces beyond
 * that of the faces, delta = delta_master - delta_slave.
 */
template <typename Number>
struct FaceIntegrals
{
  std::vector<Number>                   slave;        ///< int N_j
  dealii::Table<2, Number>              slave_slave;  ///< int N_j N_l
  std::vector<dealii::Table<2, Number>> slave_master; ///< int N_j N_k
  /// int (N_j N_k)^p, p the degree: never negative
  std::vector<dealii::Table<2, Number>> weights;
  dealii::Table<2, Number>              offset; ///< int N_j delta_d
};

/// All of its numbers, to be sent to other ranks.
template <typename Number>
std::vector<double> to_numbers(const FaceIntegrals<Number> &integrals);

/// Back again: of a face with @p n nodes, with faces of n_masters, from @p numbers on.
template <int dim, typename Number>
FaceIntegrals<Number>
from_numbers(unsigned int n, unsigned int n_masters, std::vector<double>::const_iterator numbers);

/**
 * What multiplier functions psi_j a slave face has; they sum to 1:
 *   biorthogonal, psi_j = sum_l A_jl N_l with A = diag(d) m^-1,
 *   d_j = int N_j, m_jl = int N_j N_l, so int psi_j N_l = d_j delta_jl and
 *   int psi_j = d_j (Wohlmuth, SIAM J. Numer. Anal. 38, 2000);
 *   biorthogonal on a partly covered face, where force would act at its nodes
 *   beyond the end of the master side: the same with the functions of the box
 *   [lower, upper] of the covered part instead of N,
 *   N~_j(xi) = N_j((xi - lower) / (upper - lower)) = sum_l box_jl N_l(xi),
 *   N_l = sum_j at_jl N~_j with at_jl = N_l at node j of the box, so that
 *   int psi_j N_l = int psi_j at_jl: a mean gap of the places of the box;
 *   or standard, psi_j = N_j, for faces covered too little for m^-1.
 */
struct MultiplierFunctions
{
  bool                     biorthogonal = true;
  dealii::Table<2, double> at, box; ///< empty: of the nodes

  /// Does row j see slave node j alone?
  bool are_nodal() const { return biorthogonal && at.empty(); }
};

/// On the box of the covered part of a face; sides of the box that lie
/// within @p tolerance, a part of the face, of its edges are these.
template <int dim>
MultiplierFunctions functions_on(CoverBox<dim> box, unsigned int degree, double tolerance);

/// Of the functions N~_j of the box instead of the face's N_j, the weights left out.
template <typename Number>
FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &integrals,
                             const MultiplierFunctions   &functions);

/// The integrals with multiplier functions.
template <typename Number>
struct FaceCoupling
{
  std::vector<Number>                   multiplier;        ///< int psi_j
  dealii::Table<2, Number>              multiplier_slave;  ///< psi_j N_l
  std::vector<dealii::Table<2, Number>> multiplier_master; ///< psi_j N_k
  dealii::Table<2, Number>              multiplier_offset; ///< psi_j delta_d
};

/// The offset of a face from its @p offsets at the samples at one point, and
/// its derivatives by the coordinates.
template <int dim, typename Number>
struct OffsetPoint
{
  static constexpr unsigned int                degree = mesh::surface_degree;
  const faces::FaceValues<dim, double, degree> values;
  std::array<Number, dim>                      offset{};
  std::array<std::array<Number, dim>, dim - 1> slopes{};

  OffsetPoint(const FaceNodes<dim, Number> &offsets, const faces::FaceCoordinates<dim, double> &xi)
    : values(degree, xi)
  {
    for (unsigned int k = 0; k < offsets.size(); ++k)
      for (int d = 0; d < dim; ++d)
        {
          offset[d] += values.value[k] * offsets[k][d];
          for (int a = 0; a < dim - 1; ++a)
            slopes[a][d] += values.gradient[k][a] * offsets[k][d];
        }
  }
};

template <int dim, typename Number>
FaceIntegrals<Number> integrate(const SegmentQuadrature<dim>               &quadrature,
                                const MortarFace<dim, Number>              &slave,
                                const std::vector<MortarFace<dim, Number>> &masters);

template <typename Number>
FaceCoupling<Number> couple(const FaceIntegrals<Number> &integrals,
                            const MultiplierFunctions   &functions);

/// The transpose of the derivative of couple(): from the gradient of a
/// scalar with respect to the coupling, that to the integrals but for the
/// weights, of which there is none.
FaceIntegrals<double> couple_transpose(const FaceIntegrals<double> &integrals,
                                       const MultiplierFunctions   &functions,
                                       const FaceCoupling<double>  &gradient);
} // namespace snug::mortar

#endif

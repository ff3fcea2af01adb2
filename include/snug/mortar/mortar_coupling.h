#ifndef snug_mortar_mortar_coupling_h
#define snug_mortar_mortar_coupling_h

#include <snug/mesh/body_mesh.h>
#include <snug/mesh/lagrange.h>
#include <snug/mortar/segment_points.h>

#include <deal.II/base/table.h>

namespace snug::mortar {
/**
 * Integrals over the covered part of a slave face, which is the part opposite to the given master
 * faces. The integrands contain the shape functions N_j of the slave face and N_k of the master
 * faces. They also contain the offset between the true surfaces beyond that of the faces,
 * delta = delta_master - delta_slave.
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

/// Return integrals of a face with @p n nodes and @p n_masters master faces, all 0.
template <int dim, typename Number>
FaceIntegrals<Number> zero_integrals(unsigned int n, unsigned int n_masters);

/// Visit all numbers of @p integrals, always in the same order.
template <typename Integrals, typename Visit>
void for_each_number(Integrals &integrals, const Visit &visit)
{
  const auto of_table = [&](auto &table) {
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      for (unsigned int j = 0; j < table.n_cols(); ++j)
        visit(table(i, j));
  };
  for (auto &number : integrals.slave)
    visit(number);
  of_table(integrals.slave_slave);
  for (auto *tables : {&integrals.slave_master, &integrals.weights})
    for (auto &table : *tables)
      of_table(table);
  of_table(integrals.offset);
}

/// Return all numbers of @p integrals, to be sent to other ranks.
template <typename Number>
std::vector<double> to_numbers(const FaceIntegrals<Number> &integrals);

/// Return the integrals of a face with @p n nodes and @p n_masters master faces, from the numbers
/// of to_numbers() at @p numbers.
template <int dim, typename Number>
FaceIntegrals<Number>
from_numbers(unsigned int n, unsigned int n_masters, std::vector<double>::const_iterator numbers);

/**
 * Multiplier functions psi_j of a slave face, which sum to 1. There are three kinds:
 * - Biorthogonal functions, psi_j = sum_l A_jl N_l with A = diag(d) m^-1,
 *   d_j = int N_j, m_jl = int N_j N_l, so int psi_j N_l = d_j delta_jl and
 *   int psi_j = d_j (Wohlmuth, SIAM J. Numer. Anal. 38, 2000).
 * - Biorthogonal functions on a partly covered face, because otherwise force would act at its nodes
 *   beyond the end of the master side. They use the functions of the box [lower, upper] of the
 *   covered part instead of N,
 *   N~_j(xi) = N_j((xi - lower) / (upper - lower)) = sum_l coefficients_jl N_l(xi),
 *   N_l = sum_j values_jl N~_j with values_jl = N_l at node j of the box, so that
 *   int psi_j N_l = int psi_j values_jl is a mean gap of the places of the box.
 * - Standard functions, psi_j = N_j, for faces that are covered too little for m^-1.
 */
struct MultiplierFunctions
{
  bool biorthogonal = true;
  /// @name Tables of the functions of a box; empty: functions of the whole face
  /// @{
  dealii::Table<2, double> values;       ///< N_l (column) at node j (row) of the box
  dealii::Table<2, double> coefficients; ///< of N_l (column) in N~_j (row)
  /// @}

  /// Return whether row j contains slave node j alone.
  bool are_nodal() const { return biorthogonal && values.empty(); }
};

/// Return the functions on the box of the covered part of a face. Sides of the box that lie within
/// @p tolerance, a fraction of the face, of the edges of the face are moved to these edges.
template <int dim>
MultiplierFunctions functions_on(CoverBox<dim> box, unsigned int degree, double tolerance);

/// Return the integrals of the functions N~_j of the box instead of the functions N_j of the face,
/// without the weights.
template <typename Number>
FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &integrals,
                             const MultiplierFunctions   &functions);

/// Integrals with multiplier functions.
template <typename Number>
struct FaceCoupling
{
  std::vector<Number>                   multiplier;        ///< int psi_j
  dealii::Table<2, Number>              multiplier_slave;  ///< int psi_j N_l
  std::vector<dealii::Table<2, Number>> multiplier_master; ///< int psi_j N_k
  dealii::Table<2, Number>              multiplier_offset; ///< int psi_j delta_d
};

template <int dim, typename Number>
FaceIntegrals<Number> integrate(const SegmentQuadrature<dim>               &quadrature,
                                const MortarFace<dim, Number>              &slave,
                                const std::vector<MortarFace<dim, Number>> &masters);

/// Add the derivatives of a scalar through the integrals to @p recording, of which @p slave and
/// @p masters are numbers. @p slopes are the derivatives of the scalar with respect to the
/// integrals of integrate(). Only one point is recorded at a time, so that little memory is needed.
template <int dim>
void add_integral_derivatives(const SegmentQuadrature<dim>                        &quadrature,
                              const MortarFace<dim, faces::Recorded>              &slave,
                              const std::vector<MortarFace<dim, faces::Recorded>> &masters,
                              const FaceIntegrals<double>                         &slopes,
                              faces::Recording                                    &recording);

template <typename Number>
FaceCoupling<Number> couple(const FaceIntegrals<Number> &integrals,
                            const MultiplierFunctions   &functions);
} // namespace snug::mortar

#endif

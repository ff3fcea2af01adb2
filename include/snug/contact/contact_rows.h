#ifndef snug_contact_contact_rows_h
#define snug_contact_contact_rows_h

#include <snug/mesh/surface.h>

#include <string>
#include <vector>

namespace snug
{
  namespace contact
  {
    /// Entries of `subsection Contact`.
    struct ContactParameters
    {
      /// "body.boundary: body.boundary", slave: master
      std::vector<std::pair<std::string, std::string>> pairs;
    };

    /// One contact pair as (body, boundary) of slave and master.
    struct Pair
    {
      std::pair<unsigned int, unsigned int> slave, master;
    };

    /**
     * Slave node s against master face: closest point with shape function
     * weights w_k at master nodes k, found once and frozen.
     * With nodal normals n_k = a_k/|a_k| of the master side (a_k: sum over
     * its faces of the area vectors t1 x t2 at node k) the unit normal is
     * n = v/|v|, v = -sum_k w_k n_k: from the slave INTO the master body.
     */
    struct Projection
    {
      unsigned int                                 pair;
      unsigned int                                 slave; ///< surface node
      std::vector<std::pair<unsigned int, double>> masters;
    };

    /**
     * One row of non-penetration, sum_a c_a . u_a <= gap:
     * c_s = n, c_k = -w_k n, gap = n . (sum_k w_k x_k - x_s) [length].
     * Hanging master nodes are replaced by their masters.
     */
    template <int dim>
    struct Row
    {
      /// surface nodes, ascending, and their coefficients
      std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> coefficients;
      double                                                       gap = 0.;
      dealii::Tensor<1, dim>                                       normal;
    };

    /**
     * Nodal (node to face) contact of all pairs. Everything is replicated on
     * all ranks; positions are fields on the surface nodes (hanging nodes
     * included). Pairing is frozen by the constructor.
     */
    template <int dim>
    class NodalContact
    {
    public:
      using Field = typename mesh::Surface<dim>::Field;

      /// Pair at the given positions. Slave nodes that hang, or whose closest
      /// point lies beyond the edge of the master side, carry no row.
      NodalContact(const mesh::Surface<dim> &surface,
                   const std::vector<Pair>  &pairs,
                   unsigned int              degree,
                   const Field              &positions);

      unsigned int
      n_rows() const;
      const std::vector<Projection> &
      projections() const;

      /// Rows at @p positions.
      std::vector<Row<dim>>
      rows(const Field &positions) const;

      /// Derivatives of the rows along @p velocity, exact: coefficients,
      /// gap and normal of each Row hold the derivatives (same nodes).
      std::vector<Row<dim>>
      row_derivatives(const Field &positions, const Field &velocity) const;

      /**
       * gradient_a = d/dX_a sum_i force_i (sum_b c_ib . u_b - gap_i), the
       * contact part of the energy gradient; all surface nodes.
       */
      Field
      energy_gradient(const Field               &positions,
                      const Field               &displacement,
                      const std::vector<double> &forces) const;

      /// Tributary slave area of each row [length^(dim-1)], shares of hanging
      /// slave nodes given to their masters.
      std::vector<double>
      areas(const Field &positions) const;

    private:
      const mesh::Surface<dim> &surface;
      std::vector<Pair>         pairs;
      unsigned int              degree;
      std::vector<Projection>   found;
    };
  } // namespace contact
} // namespace snug

#endif

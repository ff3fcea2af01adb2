#ifndef snug_contact_contact_rows_h
#define snug_contact_contact_rows_h

#include <snug/contact/nodal_normals.h>
#include <snug/contact/projection.h>
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
     * all ranks and nothing communicates; positions are fields on the surface
     * nodes (hanging nodes included). Pairing is frozen by the constructor:
     * faces and weights stay, normals and gaps follow the positions.
     *
     * Rows are ordered by pair, then by the faces of the surface, which does
     * not depend on the number of ranks.
     *
     * All functions of positions throw TangledMesh where a normal vanishes or
     * a position is not finite.
     */
    template <int dim>
    class NodalContact
    {
    public:
      using Field = typename mesh::Surface<dim>::Field;

      /**
       * Pair at the given positions. Slave nodes that hang, or whose closest
       * point lies beyond the edge of the master side (edge_tolerance), carry
       * no row. @p surface must outlive this object.
       * @throws InputError naming a pair that is left without rows.
       */
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
       * contact part of the energy gradient, for all surface nodes: hanging
       * ones count as independent positions, so their share is still to be
       * given to their masters.
       */
      Field
      energy_gradient(const Field               &positions,
                      const Field               &displacement,
                      const std::vector<double> &forces) const;

      /// Tributary slave area of each row [length^2], the integral of the
      /// slave node's shape function; shares of hanging slave nodes are given
      /// to their masters.
      std::vector<double>
      areas(const Field &positions) const;

    private:
      const mesh::Surface<dim> &surface;
      FaceShape<dim>            shape;
      std::vector<PairFaces>    sides; ///< of each pair
      std::vector<Projection>   found;
      /// of each row: surface nodes, ascending, and their factors of n in the
      /// coefficients: 1 (slave) or -w (masters, none hanging)
      std::vector<std::vector<std::pair<unsigned int, double>>> factors;

      void
      resolve_hanging();
      std::vector<NodalNormals<dim>>
      master_normals(const Field &positions) const;
    };
  } // namespace contact
} // namespace snug

#endif

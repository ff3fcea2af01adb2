#ifndef snug_io_qp_export_h
#define snug_io_qp_export_h

#include <snug/feti/loaded_problem.h>

#include <string>

namespace snug::io {
/**
 * Write the quadratic program of torn bodies and its solution for other solvers,
 * @f[ \min \tfrac12 u^T K u - f^T u \quad\text{s.t.}\quad
 *     (Bu)_i \le g_i \text{ where bounded},\ (Bu)_i = g_i \text{ elsewhere}, @f]
 * with R, whose columns span the kernel of K. The files are K, B, R, f, g, bounded, u and lambda,
 * each as NAME.petsc (PETSc's binary format) and NAME.mtx (Matrix Market). doc/export-qp.md
 * describes their contents. Collective.
 * @param[in] directory the directory, which is made.
 * @param[in] layout the rows of @p feti.
 */
void export_qp(const std::string         &directory,
               const feti::LoadedProblem &feti,
               const feti::RowLayout     &layout,
               const feti::PrimalVectors &u,
               const qp::MultiVector     &lambda);
} // namespace snug::io

#endif

/*
 * calls.inc.h - the calls that fault.c makes fail, beside those to allocate memory and open(), as
 *
 *     FAULT(type, name, (parameters), (arguments), value of a failure)
 *
 * From here the Makefile takes the names for the linker. What a failure returns may be an
 * expression that sets errno, or *code as OpenCL does; OpenCL's are those of a lost device. A
 * stream that failed says so to ferror().
 */
/* Files. */
FAULT(ssize_t, read, (int fd, void *to, size_t n), (fd, to, n), failed(EIO))
FAULT(ssize_t, write, (int fd, const void *from, size_t n), (fd, from, n), failed(ENOSPC))
FAULT(int, fsync, (int fd), (fd), failed(sync_code))
FAULT(int, close, (int fd), (fd), (__real_close(fd), failed(EIO)))
FAULT(int, rename, (const char *from, const char *to), (from, to), failed(EIO))
FAULT(int, mkdir, (const char *path, mode_t mode), (path, mode), failed(ENOSPC))
FAULT(int, fchmod, (int fd, mode_t mode), (fd, mode), failed(EPERM))
FAULT(int, access, (const char *path, int how), (path, how), failed(EACCES))
FAULT(int, stat, (const char *path, struct stat *out), (path, out), failed(EIO))
FAULT(int, lstat, (const char *path, struct stat *out), (path, out), failed(EIO))
FAULT(int, fstat, (int fd, struct stat *out), (fd, out), failed(EIO))
FAULT(DIR *, opendir, (const char *path), (path), (failed(EMFILE), (DIR *)NULL))
FAULT(int, flock, (int fd, int how), (fd, how), failed(ENOLCK))
FAULT(void *, mmap, (void *at, size_t n, int rights, int how, int fd, off_t from),
      (at, n, rights, how, fd, from), (failed(ENOMEM), MAP_FAILED))
FAULT(int, mkstemp, (char *path), (path), failed(EMFILE))
FAULT(char *, mkdtemp, (char *path), (path), (failed(ENOSPC), (char *)NULL))
FAULT(FILE *, fopen, (const char *path, const char *how), (path, how),
      (failed(EMFILE), (FILE *)NULL))
FAULT(size_t, fread, (void *to, size_t size, size_t n, FILE *file), (to, size, n, file),
      (failed_stream = file, failed(EIO), 0))
FAULT(int, fflush, (FILE * file), (file), (failed_stream = file, failed(EIO)))
FAULT(int, fclose, (FILE * file), (file), (__real_fclose(file), failed(EIO)))
FAULT(int, setrlimit, (__rlimit_resource_t what, const struct rlimit *to), (what, to),
      failed(EPERM))
FAULT(int, atexit, (void (*function)(void)), (function), -1)
FAULT(int, posix_fallocate, (int fd, off_t from, off_t n), (fd, from, n), ENOSPC)

/* Threads. */
FAULT(int, pthread_create,
      (pthread_t * out, const pthread_attr_t *how, void *(*run)(void *), void *data),
      (out, how, run, data), EAGAIN)
FAULT(int, pthread_mutex_init, (pthread_mutex_t * out, const pthread_mutexattr_t *how), (out, how),
      ENOMEM)
FAULT(int, pthread_cond_init, (pthread_cond_t * out, const pthread_condattr_t *how), (out, how),
      ENOMEM)
FAULT(int, pthread_condattr_init, (pthread_condattr_t * out), (out), ENOMEM)

/* OpenCL. */
FAULT(cl_int, clGetPlatformIDs, (cl_uint n, cl_platform_id *out, cl_uint *count), (n, out, count),
      CL_OUT_OF_HOST_MEMORY)
FAULT(cl_int, clGetDeviceIDs,
      (cl_platform_id p, cl_device_type type, cl_uint n, cl_device_id *out, cl_uint *count),
      (p, type, n, out, count), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clGetDeviceInfo,
      (cl_device_id d, cl_device_info what, size_t n, void *out, size_t *size),
      (d, what, n, out, size), CL_OUT_OF_RESOURCES)
FAULT(cl_context, clCreateContext,
      (const cl_context_properties *p, cl_uint n, const cl_device_id *d,
       void (*tell)(const char *, const void *, size_t, void *), void *user, cl_int *code),
      (p, n, d, tell, user, code), (*code = CL_OUT_OF_RESOURCES, (cl_context)NULL))
FAULT(cl_command_queue, clCreateCommandQueue,
      (cl_context c, cl_device_id d, cl_command_queue_properties p, cl_int *code), (c, d, p, code),
      (*code = CL_OUT_OF_RESOURCES, (cl_command_queue)NULL))
FAULT(cl_mem, clCreateBuffer,
      (cl_context c, cl_mem_flags flags, size_t n, void *host, cl_int *code),
      (c, flags, n, host, code), (*code = CL_MEM_OBJECT_ALLOCATION_FAILURE, (cl_mem)NULL))
FAULT(cl_program, clCreateProgramWithSource,
      (cl_context c, cl_uint n, const char **text, const size_t *length, cl_int *code),
      (c, n, text, length, code), (*code = CL_OUT_OF_HOST_MEMORY, (cl_program)NULL))
FAULT(cl_int, clBuildProgram,
      (cl_program p, cl_uint n, const cl_device_id *d, const char *options,
       void (*tell)(cl_program, void *), void *user),
      (p, n, d, options, tell, user), CL_BUILD_PROGRAM_FAILURE)
FAULT(cl_int, clGetProgramBuildInfo,
      (cl_program p, cl_device_id d, cl_program_build_info what, size_t n, void *out, size_t *size),
      (p, d, what, n, out, size), CL_OUT_OF_RESOURCES)
FAULT(cl_kernel, clCreateKernel, (cl_program p, const char *name, cl_int *code), (p, name, code),
      (*code = CL_OUT_OF_HOST_MEMORY, (cl_kernel)NULL))
FAULT(cl_int, clSetKernelArg, (cl_kernel k, cl_uint i, size_t n, const void *value),
      (k, i, n, value), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clGetKernelWorkGroupInfo,
      (cl_kernel k, cl_device_id d, cl_kernel_work_group_info what, size_t n, void *out,
       size_t *size),
      (k, d, what, n, out, size), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clGetMemObjectInfo, (cl_mem m, cl_mem_info what, size_t n, void *out, size_t *size),
      (m, what, n, out, size), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clEnqueueNDRangeKernel,
      (cl_command_queue q, cl_kernel k, cl_uint dim, const size_t *from, const size_t *global,
       const size_t *local, cl_uint n, const cl_event *wait, cl_event *out),
      (q, k, dim, from, global, local, n, wait, out), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clEnqueueReadBuffer,
      (cl_command_queue q, cl_mem m, cl_bool block, size_t from, size_t n, void *out, cl_uint count,
       const cl_event *wait, cl_event *event),
      (q, m, block, from, n, out, count, wait, event), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clEnqueueWriteBuffer,
      (cl_command_queue q, cl_mem m, cl_bool block, size_t from, size_t n, const void *in,
       cl_uint count, const cl_event *wait, cl_event *event),
      (q, m, block, from, n, in, count, wait, event), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clEnqueueCopyBuffer,
      (cl_command_queue q, cl_mem a, cl_mem b, size_t from, size_t to, size_t n, cl_uint count,
       const cl_event *wait, cl_event *event),
      (q, a, b, from, to, n, count, wait, event), CL_OUT_OF_RESOURCES)
FAULT(void *, clEnqueueMapBuffer,
      (cl_command_queue q, cl_mem m, cl_bool block, cl_map_flags flags, size_t from, size_t n,
       cl_uint count, const cl_event *wait, cl_event *event, cl_int *code),
      (q, m, block, flags, from, n, count, wait, event, code),
      (*code = CL_MAP_FAILURE, (void *)NULL))
FAULT(cl_int, clFlush, (cl_command_queue q), (q), CL_OUT_OF_RESOURCES)
FAULT(cl_int, clFinish, (cl_command_queue q), (q), (__real_clFinish(q), CL_OUT_OF_RESOURCES))

#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Boots the systemd of a root, in namespaces that stages.sh has made, with unit.sh as its last unit.
# usage: boot.sh ROOT
set -eu
root=$1
mount --make-rprivate /
mount --bind "$root" "$root"
for folder in run tmp dev; do
    mount -t tmpfs tmpfs "$root/$folder"
done
mount -t proc proc "$root/proc"
mount -t sysfs -o ro sysfs "$root/sys"
# control groups of its own: those of version 2, or the one hierarchy of version 1 that systemd is content with
if [ -e /sys/fs/cgroup/cgroup.controllers ]; then
    mount -t cgroup2 cgroup2 "$root/sys/fs/cgroup"
else
    mount -t tmpfs tmpfs "$root/sys/fs/cgroup"
    mkdir "$root/sys/fs/cgroup/systemd"
    mount -t cgroup -o none,name=systemd cgroup "$root/sys/fs/cgroup/systemd"
fi
for device in null zero full random urandom tty; do
    touch "$root/dev/$device"
    mount --bind "/dev/$device" "$root/dev/$device"
done
ln -s /proc/self/fd "$root/dev/fd"
ln -s pts/ptmx "$root/dev/ptmx"
mkdir "$root/dev/shm" "$root/dev/pts"
touch "$root/dev/console" "$root/dev/kmsg"
ip link set lo up

printf '[Service]\nExecStart=/bin/sh /unit.sh\n' >"$root/etc/systemd/system/unit-test.service"
ln -sf /etc/systemd/system/unit-test.service "$root/etc/systemd/system/multi-user.target.wants/"
cd "$root"
mkdir -p before
pivot_root . before
umount -l before
# it does what a machine's does not need in a container
exec env -i container=lxc PATH=/usr/sbin:/usr/bin /lib/systemd/systemd --system --log-target=null
